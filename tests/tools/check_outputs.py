# Compiles every sample with some of the profiles into every format of sheets, and with one of them into all others,
# which know little of it: models, pages, documents. What a profile does depends little on the sample: two samples are
# compiled with every profile, the others with every third, so that each profile has a third of the samples. --every
# compiles all with all. Reads each file back with programs and readers that are not
# popupc's: what all formats say of the lines must agree with the report, and with each other.
#
#   check_outputs.py PROGRAM SAMPLES SCRATCH [--every] [--jobs N] [--sample NAME]... [--profile NAME]...
#
# SCRATCH is made anew; the files of a run that had a problem stay there. One line a problem, then a summary that also
# says what was skipped for want of a program. Exit status 0: all is well; 1: there is a problem; 77: there is no
# program or no sample.
import argparse
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True  # nothing is written beside the sources
import read_models
import read_sheets

TOOLS = ("xmllint", "rsvg-convert", "qpdf", "pdfinfo", "gs", "librecad", "pdftoppm", "pdftotext", "pdffonts")
HAVE = {name for name in TOOLS if shutil.which(name)}
# Pixels an inch of .png: popupc's default once a profile, and what takes less time.
DPI, FEWER_DPI = 300, 100
MM_A_POINT = 25.4 / 72
FLAT = 0.0105  # mm that curves and their chords are apart, at most
MODEL_KINDS = {"scene", "page", "document"}  # formats that drawings of flat parts do not have, and profiles hardly shape
# Samples that are looked at more closely: one of one piece that is only cut, one of several that are glued.
CLOSE = ("castle", "house")

Run = collections.namedtuple("Run", "folder report profile formats kinds dpi")


class Findings:
    """What one job found: problems as lines, files that were checked by suffix, and what could not be checked."""

    def __init__(self, where):
        self.where, self.problems, self.checked, self.notes = where, [], collections.Counter(), set()

    def add(self, file, what):
        self.problems.append(f"{self.where}: {file}: {what}")

    def without(self, tool, what):
        if tool not in HAVE:
            self.notes.add(f"{what}: there is no {tool}")
            return True
        return False


def tool(*words, timeout=120, **options):
    """A program's exit status and all it said; a program that hangs has the status None."""
    try:
        done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, timeout=timeout, **options)
        return done.returncode, done.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired:
        return None, f"still running after {timeout} s"


def last_line(text):
    return (text.strip().splitlines() or ["(it said nothing)"])[-1][:300]


# ---- lines: a path is (points, closed), a sheet's lines are paths by layer -------------------------------------------

def length(paths):
    total = 0.0
    for points, closed in paths:
        total += math.fsum(map(math.dist, points, points[1:]))
        total += math.dist(points[-1], points[0]) if closed else 0.0
    return total


def curves(paths):
    return sum(getattr(points, "curves", 0) for points, _ in paths)


def away_from(point, paths, most):
    """Whether a point is further than this from all lines of the paths."""
    x, y = point
    for points, closed in paths:
        for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1] if closed else points[1:]):
            if min(ax, bx) - most > x or max(ax, bx) + most < x or min(ay, by) - most > y or max(ay, by) + most < y:
                continue
            along = (bx - ax) ** 2 + (by - ay) ** 2
            t = max(0.0, min(1.0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / along)) if along else 0.0
            if math.dist(point, (ax + t * (bx - ax), ay + t * (by - ay))) <= most:
                return False
    return True


def strays(these, those, cell):
    """How many points of `these` have none of `those` within a cell or two, and the first of them.

    A point on a curve, or beside one, only has to lie near it: formats divide curves as they like."""
    def place(point):
        return round(point[0] / cell), round(point[1] / cell)

    there = {place(point) for points, _ in those for point in points}
    away, curved = [], [path for path in those if curves([path])]
    for points, closed in these:
        beside = those if curves([(points, closed)]) else curved
        for point in points:
            x, y = place(point)
            if not any((x + i, y + j) in there for i in (-1, 0, 1) for j in (-1, 0, 1)) and \
                    away_from(point, beside, FLAT + 1.5 * cell):
                away.append(point)
    return f"{len(away)}, the first at ({away[0][0]:.4f}, {away[0][1]:.4f}) mm" if away else None


def sides_of(run, sheet):
    """The sides of a sheet on which the report has lines; where both have, there is a view of each."""
    return {view["side"] for view in run.report["cut"]["sheets"] if view["sheet"] == sheet}


def views_of(run):
    """All sheets in their order, each as (number, whether it is a back beside a front)."""
    return [(sheet, back) for sheet in range(1, run.report["layout"]["sheets"] + 1) for back in (False, True)
            if not back or sides_of(run, sheet) == {"front", "back"}]


def of_view(run, view):
    """What the report says of one of views_of()."""
    sheet, back = view
    both = len(sides_of(run, sheet)) == 2
    return [row for row in run.report["cut"]["sheets"]
            if row["sheet"] == sheet and (not both or (row["side"] == "back") == back)]


def expected_lines(run, sheet_view):
    """Of one sheet by the report: length and number of paths by layer; the layers are in the order of being done."""
    lengths, paths, outer = {}, collections.Counter(), collections.Counter()
    for view in of_view(run, sheet_view):
        for row in view["operations"]:
            lengths[row["layer"]] = lengths.get(row["layer"], 0.0) + row["length_mm"]
            paths[row["layer"]] += row["paths"]
            outer[row["layer"]] += row["paths"] if row["operation"] == "outer-cut" else 0
    return lengths, paths, outer


def compare_lengths(lines, expected, layers, tolerance=0.01, more=None):
    """The report's lengths are those of chords: a curve may be longer by 0.02 mm. `more` are lines with curves."""
    for layer in sorted(set(expected) | (set(lines) & layers)):
        found, wanted = length(lines.get(layer, [])), expected.get(layer, 0.0)
        bent = max(curves(lines.get(layer, [])), curves((more or {}).get(layer, [])))
        if abs(found - wanted) > tolerance + 0.02 * bent:
            yield f"layer {layer} has {found:.4f} mm of lines, the report says {wanted:.4f} mm"


def compare_points(lines, drawn, layers, cell):
    """Whether two formats have their corners in the same places."""
    for layer in sorted(layers & (set(lines) | set(drawn))):
        for a, b, words in ((lines, drawn, "are not in the SVG"), (drawn, lines, "of the SVG are missing")):
            away = strays(a.get(layer, []), b.get(layer, []), cell)
            if away:
                yield f"layer {layer}: points that {words}: {away}"


# ---- sheets and pictures ---------------------------------------------------------------------------------------------

def check_rsvg(run, file, size, findings):
    if findings.without("rsvg-convert", "pictures of SVG files"):
        return
    picture = run.folder / "rsvg-out.png"
    status, said = tool("rsvg-convert", run.folder / file, "-o", picture)
    if status != 0:
        findings.add(file, f"rsvg-convert: {last_line(said)}")
        return
    width, height, _, data = read_sheets.read_png(picture.read_bytes())
    for found, mm in ((width, size[0]), (height, size[1])):
        if abs(found - mm / 25.4 * 96) > 1:
            findings.add(file, f"rsvg-convert makes it {width} x {height} pixels at 96 an inch, it has {size} mm")
            break
    if not any(data):  # all transparent
        findings.add(file, "rsvg-convert shows nothing")
    picture.unlink()


def check_dxf_paths(lines, paths, outer):
    for layer, wanted in paths.items():
        found = lines.get(layer, [])
        closed = sum(1 for _, is_closed in found if is_closed)
        if len(found) != wanted:
            yield f"layer {layer} has {len(found)} entities, the report says {wanted} paths"
        if closed < outer[layer] or (outer[layer] == wanted and closed != len(found)):
            yield f"layer {layer} has {closed} closed polylines, the report says {outer[layer]} outer cuts"


def check_hpgl(by_pen, expected, drawn):
    """Pens are numbered in the order of being done, what is cut comes last: the last pens are the report's layers."""
    layers = [layer for layer, mm in expected.items() if mm > 0]
    pens = sorted(by_pen)[-len(layers):] if layers else []
    if len(pens) != len(layers):
        yield f"{len(by_pen)} pens, the report has {len(layers)} layers"
        return
    lines = {layer: by_pen[pen] for layer, pen in zip(layers, pens)}
    for layer in layers:
        # Every end of a line is at most half a unit away in x and in y; errors of many lines cancel for the most part.
        segments = sum(len(points) - 1 for points, _ in lines[layer])
        slack = min(segments * read_sheets.UNIT * math.sqrt(2), 0.01 * expected[layer] + 4 * read_sheets.UNIT)
        yield from compare_lengths({layer: lines[layer]}, {layer: expected[layer]}, set(), 0.01 + slack)
    if drawn is not None:
        yield from compare_points(lines, drawn, set(layers), read_sheets.UNIT)


# ---- PDF -------------------------------------------------------------------------------------------------------------

def check_pdf(run, file, sizes, findings):
    path = run.folder / file
    if not findings.without("qpdf", "structure of PDF files"):
        status, said = tool("qpdf", "--check", path)
        if status != 0 or "WARNING" in said:
            findings.add(file, f"qpdf --check: {last_line(said)}")
    if not findings.without("pdfinfo", "pages of PDF files"):
        status, said = tool("pdfinfo", "-f", 1, "-l", len(sizes) + 10, path)
        pages = re.search(r"^Pages:\s+(\d+)", said, re.M)
        found = [tuple(map(float, row)) for row in re.findall(r"^Page +\d+ size: +([\d.]+) x ([\d.]+) pts", said, re.M)]
        if status != 0 or not pages:
            findings.add(file, f"pdfinfo: {last_line(said)}")
        elif int(pages.group(1)) != len(sizes) or len(found) != len(sizes):
            findings.add(file, f"{pages.group(1)} pages, the report has {len(sizes)} sheets")
        else:
            for number, (page, mm) in enumerate(zip(found, sizes), 1):
                if any(abs(a - b / MM_A_POINT) > 0.01 for a, b in zip(page, mm)):
                    findings.add(file, f"page {number} is {page} pt, the sheet is {mm} mm")


def check_plates(run, file, findings):
    """The spot colours of each page are those of the report's operations on that sheet, and have ink."""
    if findings.without("gs", "plates of PDF files"):
        return
    folder = run.folder / "plates-out"
    folder.mkdir()
    status, said = tool("gs", "-q", "-dNOPAUSE", "-dBATCH", "-dSAFER", "-sDEVICE=tiffsep", "-sCompression=none", "-r36",
                        f"-sOutputFile={folder}/%d.tif", run.folder / file)
    if status != 0:
        findings.add(file, f"gs: {last_line(said)}")
    pens = run.profile["pens"]
    for page, sheet_view in enumerate(views_of(run), 1):
        wanted = {pens[row["operation"]].get("spot") for view in of_view(run, sheet_view)
                  for row in view["operations"] if row["length_mm"] > 0} - {None}
        plates = {re.search(r"\((.*)\)", path.name).group(1): path for path in folder.glob(f"{page}(*).tif")}
        found = set(plates) - {"Cyan", "Magenta", "Yellow", "Black"}
        if found != wanted:
            findings.add(file, f"page {page} has the plates {sorted(found)}, by the report {sorted(wanted)}")
        for name in sorted(found & wanted):
            if not read_sheets.plate_has_ink(plates[name].read_bytes()):
                findings.add(file, f"page {page}: the plate {name} is empty")
    findings.checked["pdf plates"] += 1
    shutil.rmtree(folder)


def check_png(path, mm, dpi):
    width, height, row, rows = read_sheets.read_png(path.read_bytes())
    # The sheet's size is known to a millionth of a millimetre: a whole number of pixels is not to become one more.
    wanted = tuple(math.ceil(side * dpi / 25.4 - 1e-4) for side in mm)
    if (width, height) != wanted:
        yield f"{width} x {height} pixels, not {wanted[0]} x {wanted[1]}"
    if len({rows[i:i + row + 1] for i in range(0, len(rows), row + 1)}) < 3:
        yield "all rows are alike: nothing is drawn"


def check_jpg(path):
    size, scan = read_sheets.read_jpg(path.read_bytes())
    if size != (800, 650):
        yield f"it is {size} pixels, not 800 x 650"
    if scan < 2000:
        yield f"a picture of {scan} bytes shows nothing"


# ---- LibreCAD --------------------------------------------------------------------------------------------------------

PROBE = "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n100\n21\n50\n0\nENDSEC\n0\nEOF\n"


def librecad(drawing, folder):
    """None when LibreCAD turns a drawing into a page with something on it, else what happened."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", HOME=str(folder), XDG_CONFIG_HOME=str(folder),
                       XDG_RUNTIME_DIR=str(folder))
    os.chmod(folder, 0o700)
    # -t, since 2.2.0 takes no notice of -o for a single drawing; without it the page stands beside the drawing.
    status, said = tool("librecad", "dxf2pdf", "-a", "-t", folder, drawing, timeout=30, env=environment)
    page = folder / (drawing.stem + ".pdf")
    if status != 0 or not page.exists():
        return last_line(said)
    status, said = tool("pdftoppm", "-r", 50, "-gray", "-singlefile", page, folder / "page")
    if status != 0:
        return f"pdftoppm of its page: {last_line(said)}"
    picture = (folder / "page.pgm").read_bytes()
    match = re.match(rb"P5\s+(\d+)\s+(\d+)\s+255\s", picture)
    dark = sum(1 for pixel in picture[match.end():] if pixel < 250)
    shutil.rmtree(folder)
    return None if dark >= 100 else f"its page has {dark} pixels that are not white"


def check_librecad(run, file, findings):
    if findings.without("librecad", "DXF in LibreCAD") or findings.without("pdftoppm", "DXF in LibreCAD"):
        return
    # What it cannot read it tells in a window that nobody sees, and waits. So there is first a drawing that it surely
    # reads: where that makes it wait too, it is LibreCAD that does not work. And twice before that is believed.
    probe = run.folder / "probe-out.dxf"
    probe.write_text(PROBE)
    trouble = librecad(probe, run.folder / "probe-out") and librecad(probe, run.folder / "probe-out")
    probe.unlink()
    if trouble:
        findings.notes.add(f"DXF in LibreCAD: LibreCAD does not work here: {trouble}")
        return
    folder = run.folder / "librecad-out"
    trouble = librecad(run.folder / file, folder) and librecad(run.folder / file, folder)
    if trouble:
        findings.add(file, f"LibreCAD: {trouble}")
    findings.checked["dxf in librecad"] += 1


# ---- a run -----------------------------------------------------------------------------------------------------------

def compile_sample(program, sample, profile, formats, dpi, folder, jobs, environment=None):
    folder.mkdir(parents=True)
    words = [program, "build", sample, "--profile", profile, "-j", jobs, "--quiet", "--color", "never"]
    for suffix in formats:
        words += ["-o", "a" + suffix]
    if dpi != DPI:
        words += ["--dpi", dpi]
    return tool(*words, cwd=folder, env=environment)


def view_in(file):
    match = re.fullmatch(r"a(?:-(\d+))?(-back)?(?:\.book)?\.\w+", file)
    return int(match.group(1) or 1), match.group(2) is not None


def check_names(run, findings):
    """The report names all files of the run but itself, has as many as it says, and its lengths add up."""
    named, there = run.report["outputs"] + ["a.json"], {path.name for path in run.folder.iterdir()}
    for file in sorted(there - set(named)):
        findings.add(file, "the report does not name it")
    for file in sorted(set(named) - there):
        findings.add(file, "the report names it, and it is not there")
    if len(set(named)) != len(named):
        findings.add("a.json", "it names a file twice")
    total, parts = collections.Counter(), collections.Counter()
    for rows, sums in ((run.report["cut"]["operations"], total),
                       ((row for view in run.report["cut"]["sheets"] for row in view["operations"]), parts)):
        for row in rows:
            sums[row["operation"]] += row["length_mm"]
    if any(abs(total[name] - parts[name]) > 0.001 for name in total | parts):
        findings.add("a.json", f"lengths of all sheets {dict(parts)} are not those of the run {dict(total)}")
    counts = collections.Counter(suffix_of(run, file) for file in named)
    sheets, pieces = len(views_of(run)), sum(one["pieces"] for one in run.report["inputs"])
    for suffix in run.formats:
        wanted = sheets if run.kinds[suffix] == "sheet" and suffix != ".pdf" else 1
        wanted = pieces if suffix == ".jpg" else wanted
        if counts[suffix] != wanted:
            findings.add(f"*{suffix}", f"{counts[suffix]} files, not {wanted}")


def suffix_of(run, file):
    """That of its format: ".book.pdf" rather than ".pdf"."""
    ends = [suffix for suffix in run.formats if file.endswith(suffix)]
    return max(ends, key=len) if ends else pathlib.PurePath(file).suffix


def check_book(run, file, findings):
    """A book's texts have every piece, every number of a tab, and a step for each of the glued pieces."""
    if not {"pdftotext", "pdffonts"} <= HAVE:
        findings.notes.add("books: there is no pdftotext or pdffonts")
        return
    status, text = tool("pdftotext", "-layout", run.folder / file, "-")
    if status != 0:
        yield f"pdftotext: {text.strip()}"
    said = "".join(text.split())
    for piece in {row["piece"] for row in run.report["layout"]["placements"]}:
        if "".join(piece.split()) not in said:
            yield f"it does not name the piece {piece}"
    steps = [int(number) for number in re.findall(r"^[ \f]*Step (\d+):", text, re.MULTILINE)]
    if steps != list(range(1, len(steps) + 1)):
        yield f"its steps are {steps}"
    status, fonts = tool("pdffonts", run.folder / file)
    rows = [line for line in fonts.splitlines()[2:] if line.strip()]
    if status != 0 or not rows or not all(" yes yes yes " in f" {' '.join(row.split())} " for row in rows):
        yield "not all of its fonts are embedded, as subsets, with what their letters are"


def check_files(run, findings, rendered, closely):
    sizes = run.report["layout"].get("sheets_mm") or [run.report["layout"]["sheet_mm"]] * run.report["layout"]["sheets"]
    printed = {pen["layer"] for name, pen in run.profile["pens"].items()
               if name in ("fill", "draw", "glue", "label", "registration")}
    layers = {pen["layer"] for pen in run.profile["pens"].values()} - printed
    models, drawn, markup = {}, {}, []

    def examine(file):
        path, suffix, view = run.folder / file, suffix_of(run, file), view_in(file)
        size_mm, first = sizes[min(view[0], len(sizes)) - 1], view == (1, False)  # .jpg has a file a piece
        expected, paths, outer = expected_lines(run, view)
        if suffix == ".svg":
            markup.append(path)
            size, drawn[view], names = read_sheets.read_svg(path, layers)
            if any(abs(a - b) > 1e-4 for a, b in zip(size, size_mm)):
                yield f"it is {size} mm, the sheet is {size_mm} mm"
            if not names <= layers | printed:
                yield f"layers that the profile does not have: {sorted(names - layers - printed)}"
            yield from compare_lengths(drawn[view], expected, layers)
            if rendered and first:
                check_rsvg(run, file, size, findings)
        elif suffix == ".book.pdf":
            yield from check_book(run, file, findings)
        elif suffix == ".book.html":
            yield from read_models.check_book(path)
        elif suffix == ".pdf":
            check_pdf(run, file, [sizes[sheet - 1] for sheet, _ in views_of(run)], findings)
            if closely and any("spot" in pen for pen in run.profile["pens"].values()):
                check_plates(run, file, findings)
        elif suffix == ".dxf":
            if closely and first and run.profile["name"] == "workshop":
                check_librecad(run, file, findings)
            if read_sheets.ezdxf is None:
                findings.notes.add("DXF files: there is no ezdxf")
            else:
                lines = read_sheets.read_dxf(path)
                yield from compare_lengths(lines, expected, layers, more=drawn.get(view))
                if view in drawn:
                    yield from compare_points(lines, drawn[view], layers, 0.0005)
                yield from check_dxf_paths(lines, paths, outer)
        elif suffix == ".lbrn2":
            markup.append(path)
            lines = read_sheets.read_lightburn(path)
            yield from compare_lengths(lines, expected, layers, more=drawn.get(view))
            if view in drawn:
                yield from compare_points(lines, drawn[view], layers, 0.0005)
        elif suffix == ".plt":
            yield from check_hpgl(read_sheets.read_hpgl(path), expected, drawn.get(view))
        elif suffix == ".png":
            yield from check_png(path, size_mm, run.dpi)
        elif suffix == ".jpg":
            yield from check_jpg(path)
        elif suffix in (".glb", ".gltf"):
            models[suffix] = (read_models.read_glb if suffix == ".glb" else read_models.read_gltf)(path.read_bytes())
            yield from read_models.check_model(*models[suffix])
        elif suffix == ".html":
            yield from read_models.check_page(path)
        elif suffix == ".fold":
            yield from read_models.check_fold(path)
        elif suffix == ".xml":
            markup.append(path)
            ElementTree.parse(path)
        elif suffix != ".json":
            yield "nobody reads this format back: add a check of it to this test"

    # The SVG first: the others are compared with it.
    for file in sorted(run.report["outputs"] + ["a.json"], key=lambda name: not name.endswith(".svg")):
        if not (run.folder / file).exists():
            continue  # told by check_names()
        try:
            for problem in examine(file):
                findings.add(file, problem)
        except Exception as trouble:  # Whatever a reader stumbles over is a file that cannot be read.
            findings.add(file, f"it cannot be read: {type(trouble).__name__}: {trouble}")
        suffix = pathlib.PurePath(file).suffix
        if not (suffix == ".dxf" and read_sheets.ezdxf is None or suffix == ".pdf" and not {"qpdf", "pdfinfo"} & HAVE):
            findings.checked[suffix[1:]] += 1
    if not findings.without("xmllint", "XML files by libxml2") and markup:
        status, said = tool("xmllint", "--noout", *markup)
        if status != 0:
            findings.add("*", f"xmllint: {said.strip().splitlines()[0] if said.strip() else 'failed'}")
    if len(models) == 2:
        del models[".gltf"][0]["buffers"], models[".glb"][0]["buffers"]
        size = len(models[".gltf"][1])
        if models[".gltf"][0] != models[".glb"][0] or models[".gltf"][1] != models[".glb"][1][:size]:
            findings.add("a.glb", "it is not the model of a.gltf")


def check_again(run, program, sample, findings):
    """The same bytes in another directory, at another time and place, whatever the number of threads."""
    for jobs in (1, 2):
        other = run.folder.parent / f"{run.folder.name}-again-{jobs}" / "deeper"
        status, said = compile_sample(program, sample, run.profile["name"], run.formats, run.dpi, other, jobs,
                                      dict(os.environ, TZ="Asia/Kathmandu"))
        if status != 0:
            findings.add("*", f"a second run with -j {jobs}: exit {status}: {last_line(said)}")
            continue
        names = {path.name for path in run.folder.iterdir()} | {path.name for path in other.iterdir()}
        for name in sorted(names):
            files = [folder / name for folder in (run.folder, other)]
            if not all(file.exists() for file in files) or files[0].read_bytes() != files[1].read_bytes():
                findings.add(name, f"it differs in a second run with -j {jobs}")
            findings.checked["second runs"] += 1
        if not findings.problems:
            shutil.rmtree(other.parent)


def job(task):
    program, sample, profile, formats, kinds, scratch, rendered, closely = task
    findings = Findings(f"{sample.stem}, {profile['name']}")
    folder = scratch / f"{sample.stem}-{profile['name']}"
    dpi = DPI if rendered else FEWER_DPI
    status, said = compile_sample(program, sample, profile["name"], formats, dpi, folder, 1)
    if status != 0:
        findings.add("*", f"exit {status}: {last_line(said)}")
        return findings
    try:
        report = json.loads((folder / "a.json").read_text("utf-8"))
        run = Run(folder, report, profile, formats, kinds, dpi)
        check_names(run, findings)
        if closely and profile["name"] in ("workshop", "silhouette"):
            check_again(run, program, sample, findings)
        check_files(run, findings, rendered, closely)
    except Exception as trouble:
        findings.add("a.json", f"it cannot be used: {type(trouble).__name__}: {trouble}")
    if not findings.problems:
        shutil.rmtree(folder)
    return findings


def listed(program, what):
    status, said = tool(program, "list", what, "--json")
    if status != 0:
        sys.exit(f"popupc list {what} --json: exit {status}")
    return json.loads(said)


def main():
    arguments = argparse.ArgumentParser()
    for name in ("program", "samples", "scratch"):
        arguments.add_argument(name, type=pathlib.Path)
    arguments.add_argument("--every", action="store_true")
    arguments.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments.add_argument("--sample", action="append")
    arguments.add_argument("--profile", action="append")
    given = arguments.parse_args()

    program = given.program.resolve()
    samples = sorted(given.samples.resolve().glob("*.xml")) + sorted(given.samples.resolve().glob("*.svg"))
    if not os.access(program, os.X_OK) or not samples:
        print("there is no program, or there are no samples")
        return 77
    profiles = listed(program, "profiles")
    # Pictures of models are looked at by rays, pixel by pixel, where the model is at hand (still_test.cpp).
    kinds = {row["suffix"]: row["kind"] for row in listed(program, "formats") if row["kind"] != "picture"}
    scratch = given.scratch.resolve() / "check_outputs"
    shutil.rmtree(scratch, ignore_errors=True)

    close = [path for path in samples if path.stem in CLOSE] or samples[:2]
    every = given.every or given.sample or given.profile
    tasks = []
    for number, profile in enumerate(profiles):
        for place, sample in enumerate(samples):
            if not every and sample not in close and (place - number) % 3 != 0:
                continue
            modelled = sample.suffix == ".xml" and (sample in close or place % len(profiles) == number)
            formats = [suffix for suffix, kind in kinds.items() if modelled or kind not in MODEL_KINDS]
            if (not given.sample or sample.stem in given.sample) and (
                    not given.profile or profile["name"] in given.profile):
                tasks.append((program, sample, profile, formats, kinds, scratch,
                              samples[number % len(samples)] == sample, sample in close))

    problems, checked, notes = 0, collections.Counter(), set()
    with concurrent.futures.ProcessPoolExecutor(max(given.jobs, 1)) as pool:
        for findings in pool.map(job, tasks):
            for line in findings.problems:
                print(line, flush=True)
            problems += len(findings.problems)
            checked += findings.checked
            notes |= findings.notes
    print(f"{len(tasks)} runs, files checked:", ", ".join(f"{name} {count}" for name, count in sorted(checked.items())))
    for note in sorted(notes):
        print(f"skipped: {note}")
    print(f"{problems} problems" if problems else "no problems")
    return 1 if problems or not tasks else 0


if __name__ == "__main__":
    sys.exit(main())
