# SPDX-License-Identifier: Apache-2.0
"""The Python module beside the program: what one answers, the other answers to the last bit.

usage: NAVCAL=PROGRAM PYTHONPATH=FOLDER_OF_MODULE python3 python_test.py
"""

import ast
import collections
import json
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import types
import unittest

try:
    import numpy
except ImportError:
    print("skipped: numpy is not here (Debian package python3-numpy)")
    sys.exit(77)

import navcal

CLASSES = {"COMPASS": "compass", "IMU": "imu", "GPS": "gps", "MOTOR": "motor", "NAV": "navigation"}


def run(*arguments):
    return subprocess.run([os.environ["NAVCAL"], *arguments], check=True, stdout=subprocess.PIPE, text=True).stdout


def number(value):
    return math.nan if value is None else value


class Module(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def swing(self, name="a.cap", seconds=60):
        navcal.simulate(self.folder / name, mission="calibration_swing", seconds=seconds, effects={"hard_iron": 1})
        return self.folder / name

    def test_simulations_are_those_of_the_program(self):
        navcal.simulate(self.folder / "a.cap", mission="survey", seconds=10, seed=3, effects={"water_current": 0.5}, truth=self.folder / "a.csv")
        run("simulate", "--mission", "survey", "--seconds", "10", "--seed", "3", "--effect", "water_current=0.5", "-o", self.folder / "b.cap",
            "--truth", self.folder / "b.csv")
        self.assertEqual((self.folder / "a.cap").read_bytes(), (self.folder / "b.cap").read_bytes())
        self.assertEqual((self.folder / "a.csv").read_bytes(), (self.folder / "b.csv").read_bytes())

    def test_arrays_are_the_samples_of_the_program(self):
        capture = self.swing()
        rows = collections.defaultdict(list)
        for line in run("replay", capture).splitlines():
            row = json.loads(line, parse_float=lambda text: (text, float(text)))
            if row["class"] in CLASSES:
                rows[CLASSES[row["class"]]].append(row)
        recording = navcal.Recording(capture)
        arrays = recording.arrays()
        self.assertEqual(arrays.keys(), rows.keys())
        ports = [port.name for port in recording.ports]
        compared = 0
        for kind, columns in arrays.items():
            for at, row in enumerate(rows[kind]):
                text = row["time"][0].replace(".", "")
                self.assertEqual(columns["time_ns"][at], int(text), kind)
                if kind != "navigation":
                    self.assertEqual(ports[columns["port"][at]], row["device"])
                for name in columns.keys() & row.keys() - {"calibration", "error", "fix", "time_std"}:
                    said = row[name]
                    values = said if isinstance(said, list) else [said] * columns[name][at].size
                    for mine, its in zip(numpy.atleast_1d(columns[name][at]), values):
                        its = its[1] if isinstance(its, tuple) else number(its)
                        self.assertTrue(mine == its or (math.isnan(mine) and math.isnan(its)), f"{kind} {name}: {mine} {its}")
                        compared += 1
        self.assertGreater(compared, 10_000)
        self.assertEqual(arrays["imu"]["rate_rad_s"].shape, (len(rows["imu"]), 3))
        self.assertEqual(arrays["imu"]["over_range"].dtype, bool)
        self.assertFalse(arrays["compass"]["heading_rad"].flags.owndata, "the array shows the memory of the library's vector")
        self.assertEqual(recording.arrays(), {}, "everything was read")

    def test_pushed_bytes_are_the_samples_of_the_recording(self):
        capture = self.swing(seconds=10)
        recording = navcal.Recording(capture)
        pipeline = navcal.Pipeline.from_text(recording.configuration())
        headings = []
        for line in capture.read_text().splitlines():
            if line.startswith("#"):
                continue
            stamp, port, direction, digits = line.split()
            if direction == "<":
                made = pipeline.push(port, int(stamp.replace(".", "")), bytes.fromhex(digits))
                headings.extend(made.get("compass", {}).get("heading_rad", []))
        self.assertEqual(headings, list(recording.arrays()["compass"]["heading_rad"]))

    def test_calibrations_are_those_of_the_program(self):
        capture = self.swing(seconds=100)
        answer = navcal.calibrate([capture])
        self.assertEqual(answer.json + "\n", run("calibrate", "--json", capture))
        gyro = next(result for result in answer.calibrators if result.name == "gyro")
        scale = next(quantity for quantity in gyro.estimate if quantity.name == "scale")
        self.assertEqual(scale.value, answer.as_dict()["gyro"]["scale"])

    def test_diagnoses_are_those_of_the_program(self):
        navcal.simulate(self.folder / "a.cap", mission="survey", seconds=45, effects={"motor_field": 1})
        answer = navcal.diagnose(self.folder / "a.cap", bank=10, cache=self.folder / "mine")
        its = json.loads(run("gap", "--json", "-", "--bank", "10", "--cache", self.folder / "its", self.folder / "a.cap"))
        mine = answer.as_dict()
        for one in (mine, its):
            del one["seconds"], one["bank"]["seconds"]
        self.assertEqual(mine, its)
        self.assertEqual(answer.verdict, its["verdict"])

    def test_recordings_diagnosed_together_answer_as_the_program(self):
        for name, seed in (("a.cap", 1), ("b.cap", 2)):
            navcal.simulate(self.folder / name, mission="survey", seconds=45, effects={"motor_field": 1}, seed=seed)
        missions = [self.folder / "a.cap", str(self.folder / "b.cap")]
        answer = navcal.diagnose(missions, bank=10, without=["gps"], cache=self.folder / "mine").as_dict()
        its = json.loads(run("gap", "--json", "-", "--bank", "10", "--without", "gps", "--cache", self.folder / "its", *missions))
        for one in (answer, its):
            del one["seconds"], one["bank"]["seconds"]
        self.assertEqual(answer, its)
        with self.assertRaisesRegex(navcal.BadArgument, "without: .*sonar"):
            navcal.diagnose(missions, without=["sonar"])
        with self.assertRaisesRegex(navcal.BadArgument, "at least one"):
            navcal.diagnose([])

    def test_the_next_mission_is_that_of_the_program(self):
        navcal.simulate(self.folder / "a.cap", mission="survey", seconds=45, effects={"motor_field": 1})
        plan = navcal.plan_next_mission(self.folder / "a.cap", minutes=3, mission_out=str(self.folder / "next.toml"), bank=10, cache=self.folder / "cache")
        its = json.loads(run("gap", "next", "--json", "-", "--bank", "10", "--minutes", "3", "--cache", self.folder / "cache", "--mission-out",
            self.folder / "next.toml", self.folder / "a.cap"))
        mine = plan.as_dict()
        for one in (mine, its):
            del one["seconds"]
        self.assertEqual(mine, its)
        self.assertEqual(plan.mission_toml, (self.folder / "next.toml").read_text())
        self.assertEqual(plan.sentence, its["sentence"])
        self.assertIn("<svg", plan.page)
        navcal.simulate(self.folder / "next.cap", mission=str(self.folder / "next.toml"), seconds=30)
        with self.assertRaisesRegex(navcal.BadArgument, "minutes"):
            navcal.plan_next_mission(self.folder / "a.cap", minutes=0.1)

    def test_tables_of_pandas_show_the_arrays(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not here (Debian package python3-pandas)")
        arrays = navcal.Recording(self.swing(seconds=20)).arrays()
        frames = navcal.frames(arrays)
        self.assertEqual(frames.keys(), arrays.keys())
        imu = frames["imu"]
        self.assertEqual(imu.index[0], pandas.Timestamp(arrays["imu"]["time_ns"][0], tz="UTC"))
        self.assertEqual(len(imu["1970":]), len(imu), "dates select rows")
        numpy.testing.assert_array_equal(imu["rate_rad_s_y"], arrays["imu"]["rate_rad_s"][:, 1])
        self.assertTrue(numpy.shares_memory(imu["rate_rad_s_y"].to_numpy(), arrays["imu"]["rate_rad_s"]), "nothing is copied")
        self.assertIn("fins_rad_3", frames["motor"])
        self.same(arrays, {kind: navcal.columns(frame) for kind, frame in frames.items()})

    def test_datasets_of_xarray_show_the_arrays(self):
        try:
            import xarray
        except ImportError:
            self.skipTest("xarray is not here (Debian package python3-xarray)")
        arrays = navcal.Recording(self.swing(seconds=20)).arrays()
        datasets = navcal.datasets(arrays)
        imu = datasets["imu"]
        self.assertIsInstance(imu, xarray.Dataset)
        self.assertEqual(imu["rate_rad_s"].dims, ("time", "axis"))
        self.assertEqual(float(imu["rate_rad_s"].sel(axis="z")[3]), arrays["imu"]["rate_rad_s"][3, 2])
        self.assertTrue(numpy.shares_memory(imu["rate_rad_s"].values, arrays["imu"]["rate_rad_s"]), "nothing is copied")
        self.assertEqual(datasets["motor"]["fins_rad"].dims, ("time", "fin"))
        self.same(arrays, {kind: navcal.columns(dataset) for kind, dataset in datasets.items()})

    def same(self, arrays, others):
        for kind, columns in arrays.items():
            self.assertEqual(columns.keys(), others[kind].keys(), kind)
            for name, values in columns.items():
                numpy.testing.assert_array_equal(values, others[kind][name], f"{kind} {name}")

    def test_a_frame_goes_in_as_a_file(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not here (Debian package python3-pandas)")
        navcal.simulate(self.folder / "a.cap", mission="survey", seconds=10, truth=self.folder / "a.csv")
        truth = pandas.read_csv(self.folder / "a.csv")
        truth["rpm"] *= 0.5
        truth.to_csv(self.folder / "slow.csv", index=False)
        navcal.simulate(self.folder / "slow.cap", drive=self.folder / "slow.csv", truth=self.folder / "b.csv")
        self.assertLess(pandas.read_csv(self.folder / "b.csv")["u"].iloc[-1], truth["u"].iloc[-1])

    def test_progress_may_cancel_and_raise(self):
        capture = self.swing(seconds=20)
        shares = []
        navcal.calibrate([capture], progress=lambda step, share: shares.append(share))
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1)
        with self.assertRaises(navcal.Cancelled):
            navcal.calibrate([capture], progress=lambda step, share: share < 0.5)
        with self.assertRaises(ZeroDivisionError):
            navcal.calibrate([capture], progress=lambda step, share: 1 / 0)
        with self.assertRaises(navcal.Cancelled):
            navcal.simulate(self.folder / "b.cap", mission="survey", progress=lambda step, share: False)
        self.assertFalse((self.folder / "b.cap").exists())

    def test_ctrl_c_ends_a_job(self):
        started = threading.Event()

        def interrupt():
            started.wait()
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            navcal.simulate(self.folder / "a.cap", mission="survey", seconds=1e6, progress=lambda step, share: started.set())
        thread.join()
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_bad_input_is_an_exception_that_names_it(self):
        (self.folder / "garbage.cap").write_bytes(b"\0garbage")
        for name in ("missing.cap", "garbage.cap"):
            for job in (navcal.Recording, navcal.diagnose, lambda file: navcal.calibrate([file])):
                with self.assertRaisesRegex(navcal.BadInput, name):
                    job(self.folder / name)
        with self.assertRaisesRegex(navcal.BadArgument, "warp_drive"):
            navcal.simulate(self.folder / "a.cap", mission="survey", effects={"warp_drive": 1})
        with self.assertRaisesRegex(TypeError, "misson"):
            navcal.simulate(self.folder / "a.cap", misson="survey")
        with self.assertRaises(navcal.Error):
            navcal.calibrate([])

    def test_the_stub_names_what_there_is(self):
        stub = ast.parse(pathlib.Path(navcal.__file__).with_suffix(".pyi").read_text())
        for item in stub.body:
            if isinstance(item, ast.ClassDef):
                members = {part.name for part in item.body if isinstance(part, ast.FunctionDef)}
                members |= {part.target.id for part in item.body if isinstance(part, ast.AnnAssign)}
                public = {name for name in vars(getattr(navcal, item.name)) if not name.startswith("_")}
                self.assertEqual({name for name in members if not name.startswith("_")}, public, item.name)
        named = {item.name for item in stub.body if isinstance(item, (ast.ClassDef, ast.FunctionDef))}
        public = {name for name, value in vars(navcal).items() if not isinstance(value, types.ModuleType)}
        self.assertEqual(named, {name for name in public if not name.startswith("_")})

    def test_the_version_is_that_of_the_program(self):
        self.assertEqual(run("--version").split(), ["navcal", navcal.__version__])


if __name__ == "__main__":
    unittest.main()
