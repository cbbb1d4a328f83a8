"""What the report of track_bag says of a recorded sequence. track_bag must be in PATH."""
import json
import pathlib
import subprocess
import tempfile


def spacing_of(data, name):
    """Particle spacing of a recorded sequence [m]."""
    return json.loads((data / f"{name}.json").read_text())["r_m"]


def track(bag, mesh, spacing, *options):
    """Tracks with two threads and no output but the report: a dictionary for every frame."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.jsonl"
        subprocess.run(["track_bag", "--bag", bag, "--mesh", mesh, "--spacing", repr(spacing), "--out", folder,
                        "--format", "none", "--threads", "2", "--quiet", "--report", report, *options],
                       check=True, stdout=subprocess.DEVNULL)
        return [json.loads(line) for line in report.read_text().splitlines()]
