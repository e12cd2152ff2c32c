"""Prints the sources below src/ that may lack an include after a change: those that changed, and those that include,
directly or through others, a header that has lost an include. Headers that changed otherwise touch nearly every source.

    affected_sources.py BASE      # a commit; without it, all sources
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#include "([^"]+)"', re.MULTILINE)


def resolved(name, beside):
    """The file below the root that #include "name" means; None: a library's."""
    for folder in (ROOT / "include", ROOT / "src", beside):
        if (folder / name).is_file():
            return (folder / name).resolve()
    return None


def changed_since(base):
    """The sources that changed, and the headers of which an include was taken out."""
    diff = subprocess.run(["git", "diff", "-U0", "--no-renames", base, "--", "*.h", "*.cpp"], cwd=ROOT, check=True,
                          capture_output=True, text=True).stdout
    changed = set()
    file = None
    for line in diff.splitlines():
        if line.startswith("diff --git "):
            file = (ROOT / line.rsplit(" b/", 1)[1]).resolve()
        if file.suffix == ".cpp" or line.startswith("-#include"):
            changed.add(file)
    return changed


def main():
    sources = sorted((ROOT / "src").rglob("*.cpp"))
    if len(sys.argv) < 2:
        changed = {path.resolve() for path in sources}
    else:
        changed = changed_since(sys.argv[1])
    includes = {}

    def touches(path):
        """Whether the file or what it includes has changed."""
        seen, open_files = {path}, [path]
        while open_files:
            file = open_files.pop()
            if file in changed:
                return True
            if file not in includes:
                names = INCLUDE.findall(file.read_text(encoding="utf-8"))
                includes[file] = [found for name in names if (found := resolved(name, file.parent))]
            for found in includes[file]:
                if found not in seen:
                    seen.add(found)
                    open_files.append(found)
        return False

    for path in sources:
        if touches(path.resolve()):
            print(path.relative_to(ROOT))


main()
