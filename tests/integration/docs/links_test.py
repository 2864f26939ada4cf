#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Links between the repository's pages lead somewhere. Nothing is fetched: a link to another host fails unless that
host is one of the few below."""
import pathlib
import unittest
import urllib.parse

import pages

HOSTS = {"semver.org", "github.com"}


class Links(unittest.TestCase):
    def test_lead_to_files_and_headings_that_are_there(self):
        seen = 0
        for page in pages.all_pages():
            for line, target in page.links():
                if urllib.parse.urlsplit(target).scheme:
                    continue
                seen += 1
                with self.subTest(f"{page.name}:{line}: {target}"):
                    self.check(page, target)
        self.assertGreater(seen, 80)

    def check(self, page, target):
        file, _, anchor = target.partition("#")
        path = (page.path.parent / urllib.parse.unquote(file)).resolve() if file else page.path
        self.assertTrue(path.is_relative_to(pages.SOURCE), "leads out of the repository")
        self.assertTrue(path.exists(), "there is no such file")
        if anchor:
            self.assertEqual(path.suffix, ".md", "only pages have headings")
            self.assertIn(anchor, list(pages.parse(path).anchors()), "there is no such heading")

    def test_to_other_hosts_are_few(self):
        for page in pages.all_pages():
            for line, address in page.addresses():
                with self.subTest(f"{page.name}:{line}: {address}"):
                    self.assertIn(urllib.parse.urlsplit(address).hostname, HOSTS)

    def test_reach_every_page_of_the_book_from_its_contents(self):
        contents = pages.SOURCE / "docs" / "README.md"
        linked = {(contents.parent / target.partition("#")[0]).resolve()
                  for _, target in pages.parse(contents).links() if not target.startswith("http")}
        for file in sorted((pages.SOURCE / "docs").glob("*.md")):
            if file != contents:
                with self.subTest(file.name):
                    self.assertIn(file, linked)

    def test_show_every_picture_of_the_book_somewhere(self):
        used = {(page.path.parent / target).resolve() for page in pages.all_pages() for _, target in page.links()
                if not target.startswith("http")}
        for file in sorted((pages.SOURCE / "docs").iterdir()):
            if file.suffix in (".png", ".svg"):
                with self.subTest(file.name):
                    self.assertIn(file, used)


class TheReader(unittest.TestCase):
    """Of these tests themselves."""

    def test_makes_anchors_as_github_does(self):
        page = pages.Page(pathlib.Path("x.md"), ((1, "# Who can do what: the threat model"), (2, "## `a b` (c)"),
                                                 (3, "## Twice"), (4, "## Twice"), (5, "## Ten-minute rule, 3 C")), ())
        self.assertEqual(list(page.anchors()), ["who-can-do-what-the-threat-model", "a-b-c", "twice", "twice-1",
                                                "ten-minute-rule-3-c"])

    def test_takes_no_link_from_code(self):
        page = pages.Page(pathlib.Path("x.md"), ((1, "a [b](c.md) `[d](e.md)` ![f](g.png) [![h](i.png)](j.md)"),), ())
        self.assertEqual({target for _, target in page.links()}, {"c.md", "g.png", "i.png", "j.md"})


if __name__ == "__main__":
    unittest.main()
