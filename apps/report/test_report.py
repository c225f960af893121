"""Tests of the report on a tiny result written with h5py, in the layout of docs/output_format.md."""

import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.dont_write_bytecode = True
os.environ.setdefault("MPLCONFIGDIR", tempfile.gettempdir())
sys.path.insert(0, str(Path(__file__).resolve().parent))

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import mudline_report  # noqa: E402
import report_answer  # noqa: E402
import report_pictures  # noqa: E402
from report_result import Field, FieldResult, History, stress_invariants  # noqa: E402
from mudline import Results  # noqa: E402


def write_result(path, with_body=True):
    """One quad9 and, right of it, two tri6 on [0, 2] x [0, 1]; two stages, and a step without its time."""
    x, y = np.meshgrid(np.arange(5) * 0.5, np.arange(3) * 0.5)
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(15)])
    cells = [[35, 0, 2, 12, 10, 1, 7, 11, 5, 6], [36, 2, 4, 14, 3, 9, 8], [36, 2, 14, 12, 8, 13, 7]]
    with h5py.File(path, "w") as file:
        file.attrs.update(
            {"format": "mudline fields", "format version": 1, "geometry": "axisymmetric", "nodes": 15, "elements": 3}
        )
        file["metadata/program"] = np.bytes_("mudline 0.1.0")
        file["metadata/title"] = np.bytes_("A <small> test")
        file["metadata/deck"] = np.bytes_("<ParameterList>\n</ParameterList>")
        file["mesh/topology"] = np.concatenate(cells)
        file["mesh/offset"] = np.array([0, 10, 17])
        file["mesh/region"] = np.array([0, 1, 1])
        file["mesh/region names"] = np.bytes_("clay\nsand")
        file["mesh/coordinates"] = points
        if with_body:
            file["bodies/cone/contour"] = np.array([[0, 1], [0.2, 1.3], [0, 1.3]])
            file["bodies/cone"].attrs["name"] = "cone"
        for k, (time, stage) in enumerate([(0.0, "geostatic"), (1.0, "push"), (2.0, "push"), (None, None)]):
            step = file.create_group(f"steps/{k:06d}")
            step["coordinates"] = points * [1, 1 - 0.05 * k, 1]
            for link, name, unit, values in [
                ("nodal/pore_pressure", "pore pressure", "Pa", 1e4 * points[:, 1] * k),
                ("nodal/displacement", "displacement", "m", 0.05 * k * points),
                ("cell/effective_stress", "effective stress", "Pa", np.full((3, 6), -1e3)),
            ]:
                step[link] = values
                step[link].attrs.update({"name": name, "unit": unit})
            if with_body:
                step.create_group("bodies/cone").attrs["displacement"] = [0.0, -0.05 * k]
            if time is not None:
                step.attrs.update({"step": k, "stage": stage, "time": time})


HISTORY = """\
time [s],body/cone/displacement y [m],body/cone/force y [N],"probe/a, b/pore pressure [Pa]",balance/water/error [-]
0,0,0,1000,0
1,-0.05,1500,2000,1e-9
2,-0.1,4000,2500,-2e-9
3,-0.1"""


RESULTS = """\
stage,of,quantity,value,unit
,cone,depth of the tip at the start,0.5,m
push,stage,duration,2,s
push,cone,speed,0.5,m/s
push,cone,resistance,3500,N
push,soil,half dissipated after,207360,s
,balance,error of water,1e-9,-
"""


class ReportTest(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        write_result(self.folder / "cone.h5")
        (self.folder / "cone.csv").write_text(HISTORY)

    def tearDown(self):
        self.temporary.cleanup()

    def run_report(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = mudline_report.main([str(a) for a in arguments])
            except SystemExit as stop:  # argparse
                code = stop.code
        return code, out.getvalue(), err.getvalue()

    def test_cells_are_split_and_covered(self):
        result = FieldResult(self.folder / "cone.h5")
        corners = result.coordinates(0)[result.triangles]
        a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        areas = 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
        self.assertEqual(len(areas), 8 + 4 + 4)
        self.assertTrue((areas > 0).all())
        self.assertAlmostEqual(areas.sum(), 2.0)
        self.assertEqual(len(result.boundary), 12)  # half edges around the rectangle

    def test_unfinished_step_is_left_out(self):
        result = FieldResult(self.folder / "cone.h5")
        self.assertEqual(result.stage_spans(), [["geostatic", 0, 0, 1], ["push", 1, 2, 2]])

    def test_body_moves(self):
        np.testing.assert_allclose(FieldResult(self.folder / "cone.h5").bodies(2)["cone"][0], [0, 0.9])

    def test_history_drops_the_row_cut_short(self):
        history = History(self.folder / "cone.csv")
        self.assertEqual(list(history.time), [0, 1, 2])
        self.assertEqual(list(history.groups()), ["body/cone", "probe/a, b", "balance/water"])

    def test_estimated_errors_are_bands_and_a_table(self):
        path = self.folder / "errors.csv"
        path.write_text(
            "time [s],mesh/stress error [-],body/cone/displacement y [m],contact/face/reaction y [N],contact/face/reaction y error [N]\n"
            "0,0,0,0,0\n1,0.1,-0.05,1500,150\n2,0.2,-0.1,2000,100\n"
        )
        history = History(path)
        groups = history.groups()
        figure = report_pictures.history_figure(groups["contact/face"], history.time, [])
        axes = figure.axes[0]
        self.assertEqual(len(axes.lines), 1)
        band = axes.collections[0].get_paths()[0].vertices
        self.assertAlmostEqual(band[:, 1].max(), 2.1)  # kN
        self.assertTrue(np.any(np.isclose(band, [1, 1.35]).all(axis=1)))
        self.assertEqual(len(report_pictures.history_figure(groups["mesh"], history.time, []).axes[0].lines), 1)
        forces, name, penetration, _ = report_answer.body_resistance(history, groups["body/cone"])
        axes = report_answer.load_figure("cone", forces, penetration, name, [], None).axes[0]
        self.assertEqual((len(axes.lines), len(axes.collections)), (1, 1))
        self.assertTrue(np.any(np.isclose(axes.collections[0].get_paths()[0].vertices, [1.65, 50]).all(axis=1)))
        found = mudline_report.error_table(history)
        for text in ("<td>mesh stress</td>", ">20 %<", "contact/face reaction y", ">100<", ">5 %<"):
            self.assertIn(text, found)
        self.assertEqual(mudline_report.error_table(History(self.folder / "cone.csv")), "")

    def test_resistance_is_vertical(self):
        columns = "time [s],body/ball/displacement y [m],body/ball/displacement z [m],contact/ball/reaction y [N],"
        columns += "contact/ball/reaction z [N],body/ball/force y [N],body/ball/driving force z [N]"
        (self.folder / "ball.csv").write_text(columns + "\n0,0,0,0,0,0,0\n1,5,-2,7,3,9,4")
        for name, forces, last in (("ball", {"ball": 3, "driving force z": 4}, 2.0), ("cone", {"force y": 4000}, 0.1)):
            history = History(self.folder / f"{name}.csv")
            found, _, penetration, _ = report_answer.body_resistance(history, history.groups()[f"body/{name}"])
            self.assertEqual({force: values[-1] for force, values in found.items()}, forces)
            self.assertAlmostEqual(penetration[-1], last)

    def test_results_come_first(self):
        (self.folder / "cone.results.csv").write_text(RESULTS)
        page = Path(self.run_report(self.folder / "cone.results.csv")[1].strip()).read_text()
        self.assertLess(page.index('<h2 id="results">'), page.index('<h2 id="fields">'))
        for part in ("<th class=number>push</th>", "<td>duration</td><td class=number>2 s</td>", "<td>resistance [kN]</td><td class=number>3.5</td>",
                     "<td class=number>2.4 days</td>", "<td>error of water</td><td class=number>1e-09</td>"):
            self.assertIn(part, page)
        (self.folder / "cone.results.csv").write_text(RESULTS + "push,cone,depth,deep,m\n")
        self.assertIn("cone.results.csv:8: 'deep' is not a number", self.run_report(self.folder / "cone")[2])
        (self.folder / "cone.results.csv").write_text("stage\n")
        self.assertIn("not the results of mudline", self.run_report(self.folder / "cone")[2])

    def test_depth_is_that_of_the_tip(self):
        (self.folder / "cone.results.csv").write_text(RESULTS)
        results = Results(self.folder / "cone.results.csv")
        y = np.array([9.0, 8.0, 8.5])
        np.testing.assert_allclose(report_answer.tip_depth(results, "cone", y, y - 10), [1.5, 2.5, 2.0])
        self.assertIsNone(report_answer.tip_depth(results, "pile", y, y - 10))
        (self.folder / "cone.csv").write_text(
            "time [s],body/cone/position y [m],body/cone/displacement y [m],body/cone/velocity y [m/s],contact/face/reaction y [N],"
            "contact/face/tip reaction y [N],contact/face/shaft reaction y [N]\n0,10,0,0,0,0,0\n1,9,-1,-1,3000,2000,1000\n"
        )
        history = History(self.folder / "cone.csv")
        forces, name, depth, speed = report_answer.body_resistance(history, history.groups()["body/cone"], "cone", results)
        self.assertEqual([*forces], ["face", "tip", "shaft"])
        self.assertEqual((name, list(depth), list(speed)), ("depth of the tip below the mudline", [0.5, 1.5], [0, -1]))

    def test_runs_are_compared(self):
        """What differs stands in a table with a column for each run; what is the same in all does not."""
        write_result(self.folder / "other.h5")
        (self.folder / "other.csv").write_text(HISTORY.replace("4000", "5000"))
        (self.folder / "cone.results.csv").write_text(RESULTS)
        (self.folder / "other.results.csv").write_text(RESULTS.replace("3500", "4200").replace("207360", "3600"))
        results = [self.folder / "cone", self.folder / "other"]
        code, out, err = self.run_report(*results, "--png", self.folder)
        self.assertEqual(code, 0, err)
        table = Path(out.split()[-1]).read_text().partition('<h2 id="comparison">')[2].partition("<h2")[0]
        for part in ("<th class=number>cone</th><th class=number>other</th>",
                     "<td>push</td><td>resistance [kN]</td><td class=number>3.5</td><td class=number>4.2</td>",
                     "<td>half dissipated after</td><td class=number>2.4 days</td><td class=number>60 min</td>"):
            self.assertIn(part, table)
        for same in ("speed", "duration", "error of water"):
            self.assertNotIn(same, table)
        self.assertTrue((self.folder / "comparison_cone.png").is_file())
        (self.folder / "other.results.csv").write_text(RESULTS)
        self.assertIn("All results are the same.", Path(self.run_report(*results)[1].strip()).read_text())
        for wrong, message in (([results[0], results[0]], "cone: given twice"), ([results[0], self.folder / "x"], "there is no such result"),
                               (7 * results, "14 results are too many for one report; allowed are 6")):
            code, _, err = self.run_report(*wrong)
            self.assertEqual((code, err.count("\n")), (2, 1))
            self.assertIn(message, err)

    def test_cone_penetration_test_over_depth(self):
        """Stresses share a panel, each number has its own."""
        added = ",cone/s/net cone resistance [Pa],cone/s/excess pore pressure u2 [Pa],cone/s/pore pressure ratio [-]"
        lines = HISTORY.splitlines()[:4]
        rows = [lines[0] + added] + [f"{line},{1e5 * k},{6e4 * k},0.6" for k, line in enumerate(lines[1:])]
        (self.folder / "cone.csv").write_text("\n".join(rows) + "\n")
        code, _, err = self.run_report(self.folder / "cone", "--png", self.folder)
        self.assertEqual(code, 0, err)
        self.assertTrue((self.folder / "cone_s.png").is_file())
        columns = {"net cone resistance": ("Pa", np.array([0, 1e5])), "u2": ("Pa", np.array([0, 6e4])), "u2 error": ("Pa", np.array([0, 1e3])), "B": ("-", np.array([0, 0.6]))}
        columns = {name: (unit, np.append(values, 9 * values[-1])) for name, (unit, values) in columns.items()}
        axes = report_answer.cone_figure("s", columns, np.array([0.0, 0.1, 0.1]), "depth").axes  # it rests in the end
        self.assertLess(axes[1].lines[0].get_xdata().max(), 1)
        self.assertEqual([a.get_xlabel() for a in axes], ["s [kPa]", "B [-]"])
        self.assertEqual([len(a.lines) for a in axes], [2, 1])
        self.assertEqual(axes[0].get_ylabel(), "depth [mm]")
        self.assertGreater(*axes[0].get_ylim())

    def test_whole_body_is_shown(self):
        """The left panel shows a long body wholly where the mesh is much larger, else the whole mesh."""
        shaft = {"pile": np.array([[0, -60], [0.5, -59], [0.5, -50], [0, -50]])}
        zoom = report_pictures.zoom_window(shaft, [0, 80, -140, 0], True)
        self.assertLess(zoom[3], -55)
        low, high = report_pictures.body_window(shaft, [0, 80, -140, 0], zoom)[2:]
        self.assertTrue(-64 < low < -61 and -50 < high < -46, (low, high))
        self.assertIsNone(report_pictures.body_window(shaft, [0, 20, -30, 0], zoom))
        self.assertIsNone(report_pictures.body_window({}, [0, 80, -140, 0], zoom))

    def test_both_signs_are_coloured_around_zero(self):
        for values, expected in (([-3, 4], (-4, 4)), ([-0.1, 4], (-0.1, 4)), ([1, 4], (1, 4))):
            _, _, low, high = report_pictures.colour_range(Field("x", "-", np.array(values, float), False), None)
            self.assertEqual((low, high), expected)
            self.assertEqual(report_pictures.colour_map(low, high) == report_pictures.DIVERGING, low == -high)

    def test_a_few_far_values_do_not_take_the_colours(self):
        def limits(*samples):
            return report_pictures.common_limits([Field("x", "-", values, False) for values, _ in samples], samples)

        even, far = (np.linspace(0, 1, 1001), np.ones(1001)), (np.append(np.linspace(0, 1, 1001), [50, 80]), np.ones(1003))
        self.assertEqual(limits(even), (0, 1))
        low, high = limits(even, far)
        self.assertLess(high, 1)
        self.assertEqual(report_pictures.beyond(far[0], low, high), "both")
        self.assertEqual(report_pictures.beyond(even[0], 0, 1), "neither")
        small = (np.append(np.linspace(0, 1, 100), np.full(900, 80.0)), np.append(np.ones(100), np.full(900, 1e-4)))
        self.assertLessEqual(limits(small)[1], 1)  # many values, but little area
        self.assertEqual(limits((np.append(np.zeros(1000), 5), np.ones(1001))), (0, 5))  # nothing but a far value

    def test_a_picture_as_the_one_before_is_not_drawn_again(self):
        before, after = (Field("x", "kPa", np.linspace(40, 90, 50) + more, True) for more in (0, 1e-6))
        self.assertTrue(mudline_report.is_same(before, after))
        self.assertFalse(mudline_report.is_same(before, Field("x", "kPa", np.linspace(40, 91, 50), True)))
        self.assertFalse(mudline_report.is_same(before, Field("x", "kPa", np.linspace(40, 90, 51), True)))

    def test_stress_invariants(self):
        tensor = np.array([[-1.0, 0, 0, -3.0, 0, -2.0], [0, 2.0, 0, 0, 0, 0]])
        fields = stress_invariants("effective stress", "Pa", tensor, True)
        np.testing.assert_allclose(fields["mean effective stress"].values, [2, 0])
        np.testing.assert_allclose(fields["deviatoric stress"].values, [np.sqrt(3), np.sqrt(12)])

    def test_units_get_prefixes(self):
        self.assertEqual(report_pictures.scaled("Pa", 52000), (1e-3, "kPa"))
        self.assertEqual(report_pictures.scaled("m", 0.02), (1e3, "mm"))
        self.assertEqual(report_pictures.scaled("-", 1e6), (1.0, "-"))
        self.assertEqual(report_pictures.time_unit(1e6), (1 / 86400, "days"))
        self.assertEqual(report_pictures.time_unit(591), (1 / 60, "min"))
        self.assertEqual(report_pictures.time_unit(119), (1, "s"))

    def test_history_for_a_spreadsheet(self):
        (self.folder / "cone.csv").write_text(HISTORY)
        code, _, err = self.run_report(self.folder / "cone", "--csv", self.folder / "table.csv")
        self.assertEqual(code, 0, err)
        head = (self.folder / "table.csv").read_text().splitlines()[0]
        units = [title.rpartition(" ")[2] for title in head.split(",")]
        self.assertIn("[kN]", units)
        (self.folder / "cone.csv").unlink()
        code, _, err = self.run_report(self.folder / "cone", "--csv", self.folder / "table.csv")
        self.assertEqual((code, err.count("\n")), (2, 1))
        self.assertIn("cone has no history", err)

    def test_stages_of_very_different_length_get_panels_of_their_own(self):
        time = np.concatenate([np.linspace(0, 0.1, 11), 0.1 + np.logspace(-3, 7, 50)])
        spans = [["push", 0.0, 0.1, 2], ["consolidation", 1.0, 1e7, 2]]
        figure = report_pictures.history_figure({"N": {"force y": time}, "m": {"displacement y": time}}, time, spans)
        self.assertEqual(len(figure.axes), 4)
        self.assertEqual([axes.get_xscale() for axes in figure.axes[:2]], ["linear", "log"])
        self.assertEqual(len(report_pictures.history_figure({"N": {"f": time[:11]}}, time[:11], spans[:1]).axes), 1)

    def test_page_is_complete_and_self_contained(self):
        code, out, err = self.run_report(self.folder / "cone")
        self.assertEqual((code, err), (0, ""))
        page = Path(out.strip()).read_text()
        for part in (
            "A &lt;small&gt; test",
            "mudline 0.1.0",
            "&lt;ParameterList&gt;",
            "geostatic",
            "balance",
            "2e-09",
            "mean effective stress",
            "regions: clay, sand",
        ):
            self.assertIn(part, page)
        self.assertNotIn('src="http', page)
        # pore pressure and displacement change in the push only; the stress is the same everywhere
        self.assertEqual(page.count("data:image/png;base64"), 2)
        self.assertEqual(page.count("data:image/svg+xml;base64"), 3)
        self.assertEqual(page.count(" everywhere.</p>"), 6)

    def test_pictures_of_drying_soil(self):
        """Where soil dries, its pore pressure and saturation are shown, elsewhere the excess of the pressure."""
        names = ["void ratio", "pore pressure", "excess pore pressure", "displacement"]
        step = {name: SimpleNamespace(by_cell=False) for name in names}
        result = SimpleNamespace(fields=lambda _: step, in_space=False)
        self.assertEqual(mudline_report.choose_fields(result, 0, None)[:2], ["excess pore pressure", "displacement"])
        step["saturation"] = SimpleNamespace(by_cell=True)
        self.assertEqual(mudline_report.choose_fields(result, 0, None)[:2], ["pore pressure", "saturation"])

    def test_choices_and_pictures(self):
        code, out, _ = self.run_report(
            self.folder,
            "--times",
            "0.9",
            "--fields",
            "pore pressure,displacement y",
            "--mirror",
            "--common-scale",
            "--zoom",
            "0,1,0,1",
            "--png",
            self.folder / "png",
            "-o",
            self.folder / "x.html",
        )
        self.assertEqual(code, 0)
        self.assertIn(str(self.folder / "x.html"), out)
        written = {path.name for path in (self.folder / "png").iterdir()}
        self.assertLessEqual({"pore_pressure_push_t_1.png", "displacement_y_push_t_1.png", "resistance_cone.png"}, written)
        self.assertNotIn("pore_pressure_push_t_2.png", written)

    def test_fields_or_histories_alone(self):
        (self.folder / "only.csv").write_text(HISTORY)
        self.assertEqual(self.run_report(self.folder / "only.csv")[0], 0)
        write_result(self.folder / "bare.h5", with_body=False)
        self.assertEqual(self.run_report(self.folder / "bare.h5")[0], 0)

    def test_errors_are_one_line_and_exit_2(self):
        (self.folder / "text.h5").write_text("no HDF5")
        (self.folder / "odd.csv").write_text("x,y\n1,2\n")
        (self.folder / "empty").mkdir()
        with h5py.File(self.folder / "alone.h5", "w") as file:
            file.attrs.update({"format": "mudline fields", "geometry": "plane strain"})
            file.create_group("metadata")
            file["mesh"] = h5py.ExternalLink("moved.fields/mesh.h5", "/mesh")
        for arguments, part in [
            ((self.folder / "none",), "there is no such result"),
            ((self.folder / "none.h5",), "there is no such file"),
            ((self.folder / "text.h5",), "cannot be read as an HDF5 file"),
            ((self.folder / "alone.h5",), f"they belong in the folder {self.folder / 'moved.fields'}"),
            ((self.folder / "odd",), "not a history"),
            ((self.folder / "empty",), "holds no result"),
            ((self.folder / "cone", "--fields", "temperature"), "there is no field 'temperature'; known: deviatoric"),
        ]:
            code, _, err = self.run_report(*arguments)
            self.assertEqual(code, 2, arguments)
            self.assertEqual(err.count("\n"), 1, err)
            self.assertIn(part, err)
        self.assertEqual(self.run_report(self.folder / "cone", "--times", "a,b")[0], 2)

    def test_step_that_is_being_written_is_waited_for(self):
        attempts = []

        def half_written(options, gallery):
            attempts.append(1)
            raise KeyError("addr overflow")

        with mock.patch.object(mudline_report, "build", half_written), mock.patch.object(mudline_report.time, "sleep"):
            code, _, err = self.run_report(self.folder / "cone")
        self.assertEqual((code, len(attempts)), (2, 3))
        self.assertIn("a step is being written", err)

    def test_program_runs_by_itself(self):
        done = subprocess.run(
            [sys.executable, "-B", str(Path(mudline_report.__file__)), str(self.folder / "none")],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 2)
        self.assertTrue(done.stderr.startswith("mudline report: "))


if __name__ == "__main__":
    unittest.main()
