# SPDX-License-Identifier: Apache-2.0
"""Time in which navcal fleet lists a plan of very many recordings.

Plans that many captures of a hundred bytes (default 100000), does the first thousand, and prints the times of plan, of plan once
more, of list and of merge.
"""

import argparse
import pathlib
import shutil
import subprocess
import tempfile
import time


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("navcal", type=pathlib.Path)
    parser.add_argument("recordings", type=int, nargs="?", default=100_000)
    arguments = parser.parse_args()
    navcal, count = str(arguments.navcal.resolve()), arguments.recordings
    folder = pathlib.Path(tempfile.mkdtemp(prefix="navcal-fleet-"))
    recordings, plan = folder / "recordings", folder / "plan"
    for i in range(count):
        each = recordings / f"{i // 1000:03}"
        each.mkdir(parents=True, exist_ok=True)
        (each / f"{i % 1000:03}.cap").write_text(f"#capture 1\n#port imu imu-card 57600\n1700000000.000000000 imu < {i:08x}\n")
    for name, words in (
        ("plan", ["plan", recordings, "-o", plan, "--job", "calibrate"]),
        ("plan once more", ["plan", recordings, "-o", plan, "--job", "calibrate"]),
        ("run the first 1000", ["run", plan, "--task", f"1-{min(count, 1000)}"]),
        ("list", ["list", plan]),
        ("list --json", ["list", "--json", plan]),
        ("merge", ["merge", plan]),
    ):
        began = time.monotonic()
        subprocess.run([navcal, "fleet", *words], check=True, stdout=subprocess.DEVNULL)
        print(f"{name}: {time.monotonic() - began:.2f} s", flush=True)
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
