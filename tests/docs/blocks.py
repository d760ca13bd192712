"""Runs the blocks of documentation pages and checks their links and lengths. Called by tests/docs.sh, which says how
blocks are marked."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAX_PAGE_LINES = 300
MAX_README_LINES = 150
BLOCK_TIMEOUT = 120  # s
GENERATED = {ROOT / "docs/reference/recipe.md", ROOT / "docs/reference/cli.md"}
REASON = re.compile(r"<!-- not run: (.+) -->")
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FOLDERS = "app|bindings|cmake|docs|engine|examples|materials|printers|procedural|recipe|tests"
SOURCE = re.compile(rf"`((?:{FOLDERS})/[\w./-]+)`")


@dataclass
class Block:
    line: int  # of its first line of text, from 1
    words: list  # behind the fence
    text: str
    reason: str  # why it is not run


def blocks_of(lines):
    """The fenced blocks of a page, and its other lines with their numbers."""
    blocks, prose, begin = [], [], None
    for number, line in enumerate(lines, 1):
        fence = re.match(r"\s*```(.*)$", line)
        if begin is None and fence:
            above = REASON.search(lines[number - 2]) if number > 1 else None
            begin, words, reason = number, fence[1].split(), above[1] if above else ""
        elif begin is not None and fence:
            blocks.append(Block(begin + 1, words, "\n".join(lines[begin:number - 1]) + "\n", reason))
            begin = None
        elif begin is None:
            prose.append((number, line))
    if begin is not None:
        raise ValueError(f"the block that begins in line {begin} has no end")
    return blocks, prose


def anchors_of(page):
    """The anchors of a page's headings, as GitHub names them."""
    anchors = set()
    for _, line in blocks_of(page.read_text().split("\n"))[1]:
        heading = re.match(r"#+\s+(.*)$", line)
        if not heading:
            continue
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]).replace("`", "").strip().lower()
        anchor = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        count, name = 0, anchor
        while name in anchors:
            count += 1
            name = f"{anchor}-{count}"
        anchors.add(name)
    return anchors


def broken_links(page, prose):
    """(line, message) of each link inside the repository that leads nowhere, and of each source that does not exist."""
    found = []
    for number, line in prose:
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = (page.parent / name).resolve() if name else page
            if path in GENERATED and not path.exists():
                continue
            if not path.exists():
                found.append((number, f"the link {target} leads to no file"))
            elif anchor and path.suffix == ".md" and anchor not in anchors_of(path):
                found.append((number, f"the link {target} leads to no heading"))
        if page.name == "CHANGELOG.md":
            continue  # names what is no more
        for source in SOURCE.findall(line):
            path = ROOT / source
            if not path.exists() and path not in GENERATED:
                found.append((number, f"there is no {source}"))
    return found


class Scratch:
    """A folder that looks like the root of the repository, with `lamella` on the path."""

    def __init__(self, lamella):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lamella-docs-"))
        for entry in ROOT.iterdir():
            if entry.name not in {"build", "out", ".git"}:
                (self.folder / entry.name).symlink_to(entry)
        for place in ("bin", "build/quickstart", "build/release"):
            (self.folder / place).mkdir(parents=True)
            (self.folder / place / "lamella").symlink_to(lamella)

    def run(self, command, file):
        (self.folder / file).write_text(command)
        environment = dict(os.environ, PATH=f"{self.folder / 'bin'}:{os.environ['PATH']}")
        with subprocess.Popen(["bash", "-e", file], cwd=self.folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              start_new_session=True) as process:
            try:
                return process.communicate(timeout=BLOCK_TIMEOUT)[0], process.returncode
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)  # and what it has started
                raise

    def remove(self):
        shutil.rmtree(self.folder)


def run_block(scratch, block, number):
    """What went wrong; empty if nothing did."""
    expected = next((int(word[6:]) for word in block.words if word.startswith("exits-")), 0)
    command = block.text
    if block.words[0] == "toml":
        name = block.words[2] if len(block.words) > 2 else f"recipe_{number}.toml"
        (scratch.folder / name).write_text(block.text)
        command = f"lamella info {name}\n"
    try:
        output, status = scratch.run(command, f".block_{number}.sh")
    except subprocess.TimeoutExpired:
        return f"not done after {BLOCK_TIMEOUT} s"
    if status == expected:
        return ""
    last = "\n".join("    " + line for line in output.strip().split("\n")[-12:])
    return f"exit code {status} instead of {expected}\n{last}"


def is_run(block):
    return block.words[:1] == ["sh"] or block.words[:2] == ["toml", "recipe"]


class Checker:
    def __init__(self, lamella):
        self.lamella = lamella
        self.passed = self.failed = self.skipped = 0

    def tell(self, place, message):
        """Counts one check: passed if there is no message."""
        if message:
            self.failed += 1
            print(f"{place}: {message}", flush=True)
        else:
            self.passed += 1

    def check(self, page):
        name = page.relative_to(ROOT) if page.is_relative_to(ROOT) else page
        lines = page.read_text().removesuffix("\n").split("\n")
        most = MAX_README_LINES if page == ROOT / "README.md" else MAX_PAGE_LINES
        too_long = len(lines) > most and page not in GENERATED
        self.tell(name, f"{len(lines)} lines; at most {most}" if too_long else "")
        try:
            blocks, prose = blocks_of(lines)
        except ValueError as error:
            return self.tell(name, str(error))
        broken = broken_links(page, prose)
        self.tell(name, "\n".join(f"{name}:{line}: {what}" for line, what in broken))
        scratch = None
        for number, block in enumerate(blocks, 1):
            if not is_run(block):
                continue
            place = f"{name}:{block.line}"
            if "no-run" in block.words:
                self.skipped += 1
                if not block.reason:
                    self.tell(place, "no reason above a block that is not run: <!-- not run: WHY -->")
                continue
            scratch = scratch or Scratch(self.lamella)
            self.tell(place, run_block(scratch, block, number))
        if scratch:
            scratch.remove()


def main():
    lamella = pathlib.Path(sys.argv[1]).resolve()
    if not os.access(lamella, os.X_OK):
        sys.exit(f"{lamella} is no program; build it, or name another one")
    pages = [pathlib.Path(page).resolve() for page in sys.argv[2:]]
    pages = pages or [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").rglob("*.md"))]
    checker = Checker(lamella)
    for page in pages:
        checker.check(page)
    if checker.skipped:
        print(f"{checker.skipped} blocks skipped, each with its reason on its page")
    print(f"{checker.passed} passed, {checker.failed} failed")
    return 1 if checker.failed else 0


if __name__ == "__main__":
    sys.exit(main())
