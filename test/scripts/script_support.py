"""What the tests of the scripts share: running a script, folders for files, and clouds of a bag."""
import contextlib
import functools
import importlib.machinery
import importlib.util
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np
import rosbag

PROJECT = pathlib.Path(__file__).resolve().parents[2]
NUMPY_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


class ScriptTest(unittest.TestCase):
    """A test with a folder of its own, `self.folder`."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_program(self, *arguments, exit_code=0):
        """Runs a program, holds it to its exit code, and returns what it printed and what it complained about."""
        done = subprocess.run([str(argument) for argument in arguments], capture_output=True, text=True, timeout=120,
                              check=False)
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stdout, done.stderr

    def run_script(self, script, *arguments, exit_code=0):
        """The same for main() of a script of the project, in this process, which is faster."""
        output, errors = io.StringIO(), io.StringIO()
        with unittest.mock.patch("sys.argv", [script.name, *map(str, arguments)]), contextlib.redirect_stdout(output), \
                contextlib.redirect_stderr(errors):
            try:
                code = module_of(script).main()
            except SystemExit as end:
                code = end.code
        self.assertEqual(code or 0, exit_code, output.getvalue() + errors.getvalue())
        return output.getvalue(), errors.getvalue()

    def assert_one_line(self, text, *parts):
        """An error is one line that names what is wrong."""
        self.assertEqual(len(text.strip().splitlines()), 1, text)
        for part in parts:
            self.assertIn(part, text)


@functools.cache
def module_of(script):
    loader = importlib.machinery.SourceFileLoader(script.name, str(script))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(script.name, loader))
    loader.exec_module(module)
    return module


def clouds_of(bag, topic="/particles"):
    """Messages of a bag, each with its points and its record time."""
    with rosbag.Bag(str(bag)) as opened:
        return [(message, points_of(message), time) for _, message, time in opened.read_messages([topic])]


def points_of(message):
    layout = np.dtype({"names": [field.name for field in message.fields],
                       "formats": ["<" + NUMPY_TYPES[field.datatype] for field in message.fields],
                       "offsets": [field.offset for field in message.fields], "itemsize": message.point_step})
    return np.frombuffer(message.data, layout)


def main():
    unittest.main(argv=sys.argv[:1] + ["-v"])
