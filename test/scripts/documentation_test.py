#!/usr/bin/env python3
"""The documentation is in step with the files that it quotes and names."""
import os
import re
import unittest

from script_support import PROJECT, main

PAGES = [PROJECT / "README.md"] + sorted(PROJECT.glob("docs/*.md"))


def without_code(text):
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL))


def anchors_of(path):
    """As GitHub makes them of headings."""
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
            for heading in re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)}


class Documentation(unittest.TestCase):
    def test_links_lead_somewhere(self):
        count = 0
        for page in PAGES:
            for target in re.findall(r"\]\(([^)\s]+)\)", without_code(page.read_text(encoding="utf-8"))):
                if re.match(r"[a-z]+:", target):
                    continue
                name, _, anchor = target.partition("#")
                path = page.parent / name if name else page
                self.assertTrue(path.exists(), f"{page.name}: {target}")
                if anchor:
                    self.assertIn(anchor, anchors_of(path), f"{page.name}: {target}")
                count += 1
        self.assertGreater(count, 30)

    def test_every_page_is_in_the_readme(self):
        readme = (PROJECT / "README.md").read_text(encoding="utf-8")
        for page in PAGES[1:]:
            self.assertIn(f"(docs/{page.name}", readme)

    def test_programs_can_be_called_by_their_names(self):
        count = 0
        for folder in ("scripts", "bench", "examples/own_simulator"):
            for path in (PROJECT / folder).iterdir():
                if path.is_file() and path.read_bytes().startswith(b"#!"):
                    self.assertTrue(os.access(path, os.X_OK), f"{path}: chmod +x")
                    count += 1
        self.assertGreater(count, 5)

    def test_examples_are_quoted_as_they_are(self):
        page = (PROJECT / "docs/own_simulator.md").read_text(encoding="utf-8")
        for name, language in (("simulator.cpp", "cpp"), ("simulator.py", "python")):
            code = (PROJECT / "examples/own_simulator" / name).read_text(encoding="utf-8")
            self.assertIn(f"```{language}\n{code}```", page)


if __name__ == "__main__":
    main()
