"""Meshes of other programs for the mesh source `gmsh`."""

from pathlib import Path

from mudline.abaqus import InpMesh
from mudline.errors import MudlineError
from mudline.foreign_mesh import write_msh
from mudline.universal import UnvMesh

READERS = {".inp": InpMesh, ".unv": UnvMesh}  # by the ending of the file


def import_mesh(source, target, scale=1.0):
    """Writes the mesh of an Abaqus input file (.inp) or of a universal file of I-DEAS (.unv) as MSH 2.2. scale: factor of
    all coordinates, 0.001 for a mesh in millimetres. Returns {"region": names, "side set": names, "node set": names}.
    MudlineError with file and line."""
    ending = Path(source).suffix.lower()
    if ending not in READERS:
        raise MudlineError(f"{source}: meshes of files '{ending}' are not imported; allowed: {', '.join(READERS)}")
    return write_msh(READERS[ending](source), target, scale)
