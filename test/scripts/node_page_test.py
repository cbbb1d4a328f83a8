#!/usr/bin/env python3
"""The table of parameters in docs/node.md against the code that reads them: names, types, defaults, and ranges where the
page gives them."""
import re
import unittest

from script_support import PROJECT, main

SOURCES = [PROJECT / "src/ros/live" / name for name in ("node_options.cpp", "tracker_parameters.cpp")]
PAGE = PROJECT / "docs/node.md"
NUMBER = r"-?[\d.]+(?:e\d+)?"


def code_that_reads():
    return "".join(source.read_text(encoding="utf-8") for source in SOURCES)


def read_by_the_node():
    """name -> (type, default, range or None)"""
    code = code_that_reads()
    found = {}
    for name, default in re.findall(r'source\.text\("(\w+)"\)(?:\.value_or\("(\w*)"\))?', code):
        found[name] = ("string", default, None)
    for name, default in re.findall(r'source\.flag\("(\w+)", (\w+)\)', code):
        found[name] = ("bool", default, None)
    for kind, name, *numbers in re.findall(rf'source\.(real|whole)\("(\w+)", ({NUMBER}), ({NUMBER}), ({NUMBER})\)', code):
        default, low, high = map(float, numbers)
        found[name] = ("double" if kind == "real" else "int", default, (low, high))
    for name, default in re.findall(r'read_choice<\w+>\(\s*source, "(\w+)",\s*\{\{"(\w+)"', code):
        found[name] = ("string", default, None)
    for name in re.findall(r'read_names\(source, "(\w+)"\)', code):
        found[name] = ("string", "", None)
    return found


def told_by_the_page():
    """name -> (type, default, meaning)"""
    rows = re.findall(r"^\| `~([a-z_]+)` \| (.*?) \| (.*?) \| (.*) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    return {name: (kind, "" if default == "empty" else default.strip("`"), meaning) for name, kind, default, meaning in rows}


class NodePage(unittest.TestCase):
    def test_every_call_is_understood(self):
        calls = len(re.findall(r'source\.\w+\("|source,\s*"', code_that_reads()))
        self.assertEqual(calls, len(read_by_the_node()), "a parameter is read in a way that this test does not know")

    def test_names_types_and_defaults(self):
        code, page = read_by_the_node(), told_by_the_page()
        self.assertEqual(sorted(code), sorted(page))
        for name, (kind, default, _) in code.items():
            told_kind, told_default, _ = page[name]
            # What is a number or a word is read as a string.
            self.assertEqual(kind, "string" if " or " in told_kind else told_kind, name)
            self.assertEqual(default, float(told_default) if kind in ("double", "int") else told_default, name)

    def test_ranges_where_they_are_told(self):
        count = 0
        for name, (_, _, limits) in read_by_the_node().items():
            told = re.search(rf"({NUMBER}) to ({NUMBER})", told_by_the_page()[name][2])
            if told:
                self.assertEqual(limits, (float(told[1]), float(told[2])), name)
                count += 1
        self.assertGreaterEqual(count, 3)


if __name__ == "__main__":
    main()
