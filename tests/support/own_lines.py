"""What the program itself wrote to standard error."""


def own_lines(stderr):
    """Less what mpiexec adds: a notice of its own about the exit code, framed by dashes."""
    lines, framed = [], False
    for line in stderr.splitlines():
        if line.startswith("-----"):
            framed = not framed
        elif not framed and line.strip():
            lines.append(line)
    return lines
