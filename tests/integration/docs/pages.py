# SPDX-License-Identifier: Apache-2.0
"""The repository's pages as values: what of a Markdown file is a heading, a link, a block of code, a word of code."""
import dataclasses
import pathlib
import re
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[3]

FENCE = re.compile(r"^```(.*)$")
HEADING = re.compile(r"^#{1,6} +(.*?) *#*$")
CODE_SPAN = re.compile(r"(`+)(.+?)\1", re.DOTALL)
# [text](target), ![picture](target), with brackets in the text one deep: a picture may be a link.
LINK = re.compile(r"!?\[(?:[^\[\]]|!?\[[^\[\]]*\](?:\([^()]*\))?)*\]\(([^()\s]+)\)")
PICTURE = re.compile(r"!\[[^\[\]]*\]\(([^()\s]+)\)")
ADDRESS = re.compile(r"https?://[^\s)>\"'`]+")


@dataclasses.dataclass(frozen=True)
class Block:
    """`words`: what stands behind the fence, such as ["sh", "parent"]; none of a block that is only indented."""
    line: int
    words: tuple
    text: str


@dataclasses.dataclass(frozen=True)
class Page:
    path: pathlib.Path
    prose: tuple  # (number, line), without blocks of code
    blocks: tuple

    @property
    def name(self):
        return str(self.path.relative_to(SOURCE))

    def paragraphs(self):
        """(number of the first line, text): where links and spans of code end. A table's rows are apart."""
        lines = []
        for number, line in (*self.prose, (0, "")):
            if line.strip() and not line.startswith("|"):
                lines.append((number, line))
                continue
            if lines:
                yield lines[0][0], "\n".join(text for _, text in lines)
            lines = []
            if line.strip():
                yield number, line

    def find(self, pattern, without_code=False):
        """(number of its line, match) of each place."""
        for first, text in self.paragraphs():
            if without_code:
                text = CODE_SPAN.sub(lambda span: "\n" * span.group(0).count("\n"), text)
            for match in pattern.finditer(text):
                yield first + text.count("\n", 0, match.start()), match

    def links(self):
        for pattern in (LINK, PICTURE):
            for number, match in self.find(pattern, without_code=True):
                yield number, match.group(1)

    def addresses(self):
        for number, match in self.find(ADDRESS, without_code=True):
            yield number, match.group(0)

    def code_spans(self):
        for number, match in self.find(CODE_SPAN):
            yield number, " ".join(match.group(2).split())

    def anchors(self):
        """As GitHub makes them of headings."""
        seen = {}
        for _, line in self.prose:
            heading = HEADING.match(line)
            if not heading:
                continue
            words = re.sub(r"[^\w\- ]", "", CODE_SPAN.sub(r"\2", heading.group(1)).lower())
            anchor = words.replace(" ", "-")
            seen[anchor] = seen.get(anchor, -1) + 1
            yield anchor if not seen[anchor] else f"{anchor}-{seen[anchor]}"


def parse(path):
    prose, blocks = [], []
    fence, first, content = None, 0, []
    indented = []  # lines of a block that is only indented
    blank_before = True
    in_list = False

    def end_indented():
        if indented:
            blocks.append(Block(indented[0][0], (), "\n".join(line[4:] for _, line in indented)))
            indented.clear()

    for number, line in enumerate(path.read_text().splitlines(), 1):
        mark = FENCE.match(line.strip())
        if fence is not None:
            if mark:
                width = min((len(l) - len(l.lstrip()) for l in content if l.strip()), default=0)
                blocks.append(Block(first, fence, "\n".join(l[width:] for l in content)))
                fence = None
            else:
                content.append(line)
            continue
        if mark:
            end_indented()
            fence, first, content = tuple(mark.group(1).split()), number, []
            continue
        if re.match(r"^ *([-*]|\d+\.) ", line):
            in_list = True
        elif line and not line.startswith(" "):
            in_list = False
        deep = 7 if in_list else 4  # in an item, so far is its own text
        if line.startswith(" " * deep) and (blank_before or indented):
            indented.append((number, line))
        else:
            if line.strip():
                end_indented()
            prose.append((number, line))
        blank_before = not line.strip()
    end_indented()
    if fence is not None:
        raise ValueError(f"{path}:{first}: this block has no end")
    return Page(path, tuple(prose), tuple(blocks))


def all_pages():
    """Every page that belongs to the repository, also in a tree without git."""
    listed = subprocess.run(["git", "-C", SOURCE, "ls-files", "-co", "--exclude-standard", "*.md"], capture_output=True,
                            text=True, check=False)
    if listed.returncode == 0 and listed.stdout:
        files = [SOURCE / line for line in listed.stdout.splitlines()]
    else:
        files = [f for f in SOURCE.rglob("*.md") if "build" not in f.relative_to(SOURCE).parts]
    return [parse(f) for f in sorted(files) if f.exists()]


def book():
    """What people read who use telehug: the README and docs/."""
    return [page for page in all_pages() if page.name == "README.md" or page.name.startswith("docs/")]
