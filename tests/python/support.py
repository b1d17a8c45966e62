"""The command line beside the module."""

import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "assets" / "test-samples"


def program():
    """`chromascope-cli`: that of the environment variable CHROMASCOPE_CLI, else the newest of `target`."""
    if "CHROMASCOPE_CLI" in os.environ:
        return os.environ["CHROMASCOPE_CLI"]
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    built = [path for path in target.glob("*/chromascope-cli") if path.is_file()]
    return str(max(built, key=lambda path: path.stat().st_mtime))


def command(*arguments, code=0):
    """Output of a command, and its messages on standard error."""
    done = subprocess.run([program(), *map(str, arguments)], capture_output=True, stdin=subprocess.DEVNULL)
    assert done.returncode == code, done.stderr.decode()
    return done.stdout, done.stderr.decode()
