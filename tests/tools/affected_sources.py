"""Prints the sources below src/ that may lack an include after a change: those that changed, and those that no longer
reach, directly or through others, a header that they reached. A header that has lost an include may lack it itself: its
own source, which includes it first, shows that; where it has none, those that include it do.

    affected_sources.py BASE      # a commit; without it, all sources
"""

import io
import pathlib
import re
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|(<[^>]+>))', re.MULTILINE)


class Tree:
    """Texts by name, and what each includes."""

    def __init__(self, texts):
        self.texts = texts
        self.reached = {}

    def includes(self, name):
        """What a file includes: names of files of the project, and those of libraries in their brackets."""
        found = []
        for own, library in INCLUDE.findall(self.texts[name]):
            beside = name.rsplit("/", 1)[0]
            places = (f"include/{own}", f"src/{own}", f"{beside}/{own}")
            found.append(library or next((place for place in places if place in self.texts), f"<{own}>"))
        return found

    def reach(self, name):
        """All that a file includes, directly or through others."""
        if name not in self.reached:
            seen, left = set(), [name]
            while left:
                new = [found for found in self.includes(left.pop()) if found not in seen]
                seen.update(new)
                left += [found for found in new if found in self.texts]
            self.reached[name] = seen
        return self.reached[name]


def is_source(name):
    return name.startswith("src/") and name.endswith(".cpp")


def tree_now():
    files = [path for folder in ("include", "src") for path in (ROOT / folder).rglob("*") if path.suffix in (".h", ".cpp")]
    return Tree({path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in files})


def tree_at(commit):
    archive = subprocess.run(["git", "archive", commit, "include", "src"], cwd=ROOT, check=True, capture_output=True)
    texts = {}
    with tarfile.open(fileobj=io.BytesIO(archive.stdout)) as tar:
        for member in tar:
            if member.isfile() and member.name.endswith((".h", ".cpp")):
                texts[member.name] = tar.extractfile(member).read().decode("utf-8")
    return Tree(texts)


def affected(before, now):
    """The names of the sources that may lack an include."""
    found = set()
    for name in filter(is_source, now.texts):
        if before.texts.get(name) != now.texts[name] or before.reach(name) - now.reach(name):
            found.add(name)
    for header in before.texts.keys() & now.texts.keys():
        if not header.endswith(".h") or set(before.includes(header)) <= set(now.includes(header)):
            continue
        own = next((name for name in filter(is_source, now.texts) if now.includes(name)[:1] == [header]), None)
        if own:
            found.add(own)
        else:
            found.update(name for name in filter(is_source, now.texts) if header in now.reach(name))
    return found


def main():
    now = tree_now()
    names = affected(tree_at(sys.argv[1]), now) if len(sys.argv) > 1 else filter(is_source, now.texts)
    print("".join(f"{name}\n" for name in sorted(names)), end="")


main()
