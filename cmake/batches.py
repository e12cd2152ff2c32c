"""Writes sources that compile others in batches, and prints their names, a CMake list.

    batches.py ROOT FOLDER FILE...

ROOT is the project's folder, and FOLDER where the batches go; what other runs left there is removed. Files follow each
other as they are given: neighbours instantiate the same templates. Files that have to be alone are printed as they are.

Files of one batch see each other's unnamed namespaces and headers. So no name stands in unnamed namespaces of two files of a
batch, and none that stands in one is ambiguous because of another file's headers. Conflicts that this does not see end the
build; list their files in ALONE.
"""

import pathlib
import re
import sys

# Bytes of a batch: some take a minute to compile, and 1.7 GB.
MOST = 220_000

# clang-tidy 14 cannot read the headers of qpdf; the test of a toy element links another table of elements; emitters and
# the test of gears speak of namespaces whose names others have, too.
ALONE = ("src/output/production_pdf.cpp", "src/mechanism/registry.cpp", "src/output/emit.cpp",
         "src/output/emit_design.cpp", "tests/unit/input/flatlang/flatlang_gear_test.cpp")

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
UNNAMED = re.compile(r"^namespace \{\n(.*?)^\}  // namespace\n", re.MULTILINE | re.DOTALL)
# What stands at the left margin, as clang-format sets it, up to a parameter list, a body or a value.
BEGINNING = re.compile(r"^(?!(?:namespace|template|using|return|TEST|INSTANTIATE)\b)[A-Za-z_][^\n={(;\[]*", re.MULTILINE)
TYPE = re.compile(r"(?:enum class|enum|struct|class|union) (?:\[\[\w+\]\] )?(\w+)")
VALUE = re.compile(r"[ *&>](\w+) *$")
ENUMERATORS = re.compile(r"^enum (?!class)[^{;]*\{(.*?)\}", re.MULTILINE | re.DOTALL)
USING = re.compile(r"^using (?!namespace)(?:[\w:]*::)?(\w+)(?:;| =)", re.MULTILINE)


def declared(text):
    """The names of functions, types and constants that stand at the left margin, enumerators too."""
    names = set(USING.findall(text))
    for enumerators in ENUMERATORS.findall(text):
        names.update(re.findall(r"^ *(\w+)", enumerators, re.MULTILINE))
    for beginning in BEGINNING.findall(text):
        found = TYPE.match(beginning) or VALUE.search(beginning)
        if found:
            names.add(found.group(1))
    return names


def words_of(text):
    return set(re.findall(r"\w+", text))


class Headers:
    """What the project's headers declare, say and include, each read once."""

    def __init__(self, root):
        self.root = root
        self.reached, self.declared, self.words = {}, {}, {}

    def of(self, text, beside):
        """The headers that a text includes, directly or through others."""
        found = set()
        for name in INCLUDE.findall(text):
            for folder in (self.root / "src", self.root / "include", self.root / "tests", beside):
                if (folder / name).is_file():
                    found.add(folder / name)
                    found |= self.through(folder / name)
                    break
        return found

    def through(self, header):
        if header not in self.reached:
            self.reached[header] = set()  # for headers that include themselves
            text = header.read_text()
            self.declared[header], self.words[header] = declared(text), words_of(text)
            self.reached[header] = self.of(text, header.parent)
        return self.reached[header]

    def declaring(self, name, headers):
        return [header for header in headers if name in self.declared[header]]


class Source:
    def __init__(self, path, headers):
        text = path.read_text()
        self.path = path
        self.length = len(text)
        self.words = words_of(text)
        self.own = declared("\n".join(UNNAMED.findall(text))) | set(USING.findall(text))
        self.headers = headers.of(text, path.parent)


class Batch:
    def __init__(self, headers):
        self.all_headers = headers
        self.files, self.own, self.headers, self.length = [], set(), set(), 0

    def takes(self, source):
        if self.length + source.length > MOST or self.own & source.own:
            return False
        # The file's unnamed namespace has a name that a header declares which the batch includes and the file does not: in
        # the file that name would be ambiguous.
        new_to_it = self.headers - source.headers
        if any(self.all_headers.declaring(name, new_to_it) for name in source.own):
            return False
        # An unnamed namespace of the batch has a name that a header of the file declares: where the file, or a header that
        # comes with it, uses that name, it would be ambiguous.
        new_to_them = source.headers - self.headers
        return not any(self.all_headers.declaring(name, source.headers)
                       for name in self.own
                       if name in source.words or any(name in self.all_headers.words[header] for header in new_to_them))

    def add(self, source):
        self.files.append(source.path)
        self.own |= source.own
        self.headers |= source.headers
        self.length += source.length


def main():
    root, folder, *files = map(pathlib.Path, sys.argv[1:])
    alone = {root / name for name in ALONE}
    headers = Headers(root)
    batches, printed = [], []
    for file in files:
        if file in alone:
            printed.append(file)
            continue
        source = Source(file, headers)
        batch = next((batch for batch in batches if batch.takes(source)), None)
        if batch is None:
            batch = Batch(headers)
            batches.append(batch)
        batch.add(source)
    folder.mkdir(parents=True, exist_ok=True)
    for number, batch in enumerate(batches):
        name = folder / f"{batch.files[0].parent.name}_{number}.cpp"
        text = "".join(f'#include "{file}"\n' for file in batch.files)
        if not name.is_file() or name.read_text() != text:
            name.write_text(text)
        printed.append(name)
    for old in set(folder.glob("*.cpp")) - set(printed):
        old.unlink()
    print(";".join(map(str, printed)), end="")


main()
