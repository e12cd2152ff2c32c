# Readers of sheets that know nothing of popupc: files in, lines or pixels out. A path is (points, closed), points are
# in mm with y up; curves are points close to each other, see Points. What cannot be read, or is not what a reader of
# another's would take, is a ValueError. For tests.
import math
import re
import struct
import xml.etree.ElementTree as ElementTree
import zlib

try:
    import ezdxf
except ImportError:
    ezdxf = None

UNIT = 0.025  # mm, of HP-GL
SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


class Points(list):
    """Points of a path; `curves` says how many curves of at most 30 degrees, or cubics, they are of."""
    curves = 0

    def cubic(self, one, two, end):
        start, self.curves = self[-1], self.curves + 1
        bend = max(math.dist((start[0] + two[0], start[1] + two[1]), (2 * one[0], 2 * one[1])),
                   math.dist((one[0] + end[0], one[1] + end[1]), (2 * two[0], 2 * two[1])))
        count = max(2, math.ceil(math.sqrt(0.75 * bend / 1e-4)))
        for i in range(1, count + 1):
            t = i / count
            a, b, c, d = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3
            self.append(tuple(a * p + b * q + c * r + d * s for p, q, r, s in zip(start, one, two, end)))

    def arc(self, end, bulge):
        if bulge == 0:
            self.append(end)
            return
        start, angle = self[-1], 4 * math.atan(bulge)
        self.curves += math.ceil(abs(angle) / math.radians(30) - 1e-6)
        middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        away = 0.5 / math.tan(angle / 2)
        centre = (middle[0] - away * (end[1] - start[1]), middle[1] + away * (end[0] - start[0]))
        radius = math.dist(start, centre)
        count = max(2, math.ceil(abs(angle) * math.sqrt(radius / 8e-4)))
        first = math.atan2(start[1] - centre[1], start[0] - centre[0])
        for i in range(1, count):
            turn = first + angle * i / count
            self.append((centre[0] + radius * math.cos(turn), centre[1] + radius * math.sin(turn)))
        self.append(end)


def svg_path(text):
    """The paths of straight lines and cubic curves in an SVG path's data."""
    words = re.findall(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", text)
    if re.sub(r"[\s,]", "", text) != "".join(words):
        raise ValueError(f"path data that cannot be read: {text[:60]}")
    paths, at, start, command, i = [], (0.0, 0.0), (0.0, 0.0), None, 0
    while i < len(words):
        if words[i].isalpha():
            command, i = words[i], i + 1
        if command in ("Z", "z"):
            paths[-1] = (paths[-1][0], True)
            at, command = start, None
            continue
        if command == "C":
            numbers = [float(word) for word in words[i:i + 6]]
            paths[-1][0].cubic(*zip(numbers[::2], numbers[1::2]))
            at, i = paths[-1][0][-1], i + 6
            continue
        if command is None or command not in "MmLlHhVv":
            raise ValueError(f"path command {command}")
        base = at if command.islower() else (0.0, 0.0)
        if command in "Hh":
            at, i = (base[0] + float(words[i]), at[1]), i + 1
        elif command in "Vv":
            at, i = (at[0], base[1] + float(words[i])), i + 1
        else:
            at, i = (base[0] + float(words[i]), base[1] + float(words[i + 1])), i + 2
        if command in "Mm":
            paths.append((Points([at]), False))
            start, command = at, "l" if command == "m" else "L"
        elif not paths or paths[-1][1]:
            paths.append((Points([start, at]), False))
        else:
            paths[-1][0].append(at)
    return paths


def read_svg(path, layers):
    """The size in mm, and of the named layers the lines, with y up."""
    root = ElementTree.parse(path).getroot()
    sizes = [re.fullmatch(r"([\d.]+)mm", root.get(side, "")) for side in ("width", "height")]
    box = [float(word) for word in root.get("viewBox", "").split()]
    if root.tag != SVG + "svg" or not all(sizes) or len(box) != 4:
        raise ValueError("no size in mm, or no viewBox")
    size, lines, names = [float(side.group(1)) for side in sizes], {}, set()
    if box != [0, 0, *size]:
        raise ValueError(f"the viewBox {box} is not the size {size} mm")
    for group in root.iter(SVG + "g"):
        if group.get(INKSCAPE + "groupmode") != "layer":
            continue
        name = group.get(INKSCAPE + "label")
        names.add(name)
        if name not in layers:
            continue
        for element in group.iter():
            if element.get("transform"):
                raise ValueError(f"layer {name}: a transform, which this reader does not know")
            if element.tag == SVG + "path":
                for points, closed in svg_path(element.get("d")):
                    turned = Points((x, size[1] - y) for x, y in points)
                    turned.curves = points.curves
                    lines.setdefault(name, []).append((turned, closed))
            elif element.tag != SVG + "g":
                raise ValueError(f"layer {name}: a {element.tag}, which this reader does not know")
    layered = sum(1 for group in root.iter(SVG + "g") if group.get(INKSCAPE + "groupmode") == "layer"
                  for _ in group.iter(SVG + "path"))
    if layered != sum(1 for _ in root.iter(SVG + "path")):
        raise ValueError("a path outside of all layers, or in two")
    return size, lines, names


def dxf_polyline(entity):
    rows = entity.get_points("xyb")
    points = Points([rows[0][:2]])
    for row, end in zip(rows, rows[1:] + (rows[:1] if entity.closed else [])):
        points.arc(end[:2], row[2])
    if entity.closed:
        points.pop()  # the start
    return points


def dxf_spline(entity):
    """A spline of third degree that is Bezier curves, one after the other: closed where it ends at its start."""
    controls, knots = [tuple(point)[:2] for point in entity.control_points], list(entity.knots)
    spans = (len(controls) - 1) // 3
    if entity.dxf.degree != 3 or len(controls) != 3 * spans + 1 or len(entity.weights) > 0 or \
            knots != [0] + [k for k in range(spans + 1) for _ in range(3)] + [spans]:
        raise ValueError("a spline that is not a row of Bezier curves")
    points = Points([controls[0]])
    for i in range(spans):
        points.cubic(*controls[3 * i + 1:3 * i + 4])
    closed = points[0] == points[-1]
    return points, closed


def read_dxf(path):
    document = ezdxf.readfile(path)
    audit = document.audit()
    if audit.errors or audit.fixes:
        raise ValueError("ezdxf's audit: " + "; ".join(one.message for one in audit.errors + audit.fixes)[:300])
    if document.header["$INSUNITS"] != 4:
        raise ValueError(f"$INSUNITS is {document.header['$INSUNITS']}, not 4 (mm)")
    lines = {}
    for entity in document.modelspace():
        kind, layer = entity.dxftype(), entity.dxf.layer
        if layer not in document.layers:
            raise ValueError(f"an entity is on layer {layer}, which is not in the table of layers")
        if kind == "LINE":
            path = [tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]], False
        elif kind == "LWPOLYLINE":
            path = dxf_polyline(entity), bool(entity.closed)
        elif kind == "SPLINE":
            path = dxf_spline(entity)
        elif kind == "TEXT":
            continue
        else:
            raise ValueError(f"layer {layer}: a {kind}, which is none of LINE, LWPOLYLINE, SPLINE and TEXT")
        lines.setdefault(layer, []).append(path)
    return lines


def read_lightburn(path):
    root = ElementTree.parse(path).getroot()
    if root.tag != "LightBurnProject" or root.get("FormatVersion") != "1":
        raise ValueError("not a LightBurn project of format version 1")
    names, lines = {}, {}
    for setting in root.iter("CutSetting"):
        if setting.get("type") != "Tool":
            names[setting.find("index").get("Value")] = setting.find("name").get("Value")
        else:
            names[setting.find("index").get("Value")] = None
    for shape in root.iter("Shape"):
        if shape.get("Type") != "Path" or shape.find("XForm").text.split() != ["1", "0", "0", "1", "0", "0"]:
            raise ValueError("a shape that is no path, or is moved")
        if shape.get("CutIndex") not in names:
            raise ValueError(f"a shape has cut setting {shape.get('CutIndex')}, which there is not")
        text, order = shape.find("VertList").text, shape.find("PrimList").text
        name, path = names[shape.get("CutIndex")], lightburn_path(text, order)
        if name is not None:
            lines.setdefault(name, []).append(path)
    return lines


def lightburn_path(text, order):
    number = r"(-?\d+(?:\.\d+)?)"
    vertex = f"V{number} {number}c0x(?:{number}c0y{number}|1)c1x(?:{number}c1y{number}|1)"
    if not re.fullmatch(f"(?:{vertex})+", text):
        raise ValueError(f"points that cannot be read: {text[:60]}")
    vertices = [[float(word) if word else None for word in row] for row in re.findall(vertex, text)]
    corners = [tuple(row[:2]) for row in vertices]
    open_run = "".join(f"L{i} {i + 1}" for i in range(len(corners) - 1))
    if len(corners) < 2:
        raise ValueError("a path of one point")
    if order in ("LineClosed", "LineOpen", open_run):
        return Points(corners), order == "LineClosed"
    steps = [(kind, int(a), int(b)) for kind, a, b in re.findall(r"([LB])(\d+) (\d+)", order)]
    if "".join(f"{kind}{a} {b}" for kind, a, b in steps) != order or \
            any(a != i or b != (i + 1) % len(corners) for i, (_, a, b) in enumerate(steps)) or \
            len(steps) not in (len(corners), len(corners) - 1):
        raise ValueError(f"{len(corners)} points, joined by: {order[:60]}")
    points, closed = Points(corners[:1]), len(steps) == len(corners)
    for kind, a, b in steps:
        if kind == "L":
            points.append(corners[b])
        elif None in vertices[a][2:4] or None in vertices[b][4:6]:
            raise ValueError(f"a curve from point {a} without its control points")
        else:
            points.cubic(tuple(vertices[a][2:4]), tuple(vertices[b][4:6]), corners[b])
    if closed:
        points.pop()  # the start
    return points, closed


def read_hpgl(path):
    """The lines in mm by number of pen: a plotter that knows IN, PA, SP, PU and PD."""
    lines, at, down, pen = {}, (0, 0), False, 0
    text = path.read_text("ascii")
    if not text.startswith("IN;") or not text.endswith(";\n"):
        raise ValueError("it does not begin with IN, or ends within a command")
    for word in re.sub(r"\s", "", text).split(";")[:-1]:
        match = re.fullmatch(r"(IN|PA|SP|PU|PD)((?:\d+(?:,\d+)*)?)", word)
        if not match:
            raise ValueError(f"a command that cannot be read: {word[:40]}")
        numbers = [int(number) for number in match.group(2).split(",") if number]
        if match.group(1) == "SP":
            pen, down = numbers[0], False
        elif match.group(1) in ("PU", "PD"):
            if len(numbers) % 2:
                raise ValueError(f"half a point: {word[:40]}")
            down = match.group(1) == "PD"
            points = list(zip(numbers[::2], numbers[1::2]))
            if down and points:
                if pen == 0:
                    raise ValueError("it draws without a pen")
                where = [(x * UNIT, y * UNIT) for x, y in [at, *points]]
                last = lines.setdefault(pen, [])
                if last and last[-1][0][-1] == where[0]:
                    last[-1][0].extend(where[1:])
                else:
                    last.append((where, False))
            at = points[-1] if points else at
    if down:
        raise ValueError("it ends with the pen down")
    return lines


def read_png(data):
    """Width, height, bytes a row and the rows, each after the byte of its filter."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError("not a PNG file")
    at, packed, header, ended = 8, b"", None, False
    while at + 12 <= len(data) and not ended:
        size, name = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if struct.unpack_from(">I", data, at + 8 + size)[0] != zlib.crc32(name + body):
            raise ValueError(f"the chunk {name!r} has a wrong checksum")
        if name == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif name == b"IDAT":
            packed += body
        ended, at = name == b"IEND", at + 12 + size
    if not ended or at != len(data):
        raise ValueError("it does not end with IEND")
    width, height, bits, kind, _, _, interlaced = header
    row = (width * bits * {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind] + 7) // 8
    rows = zlib.decompress(packed)
    if interlaced or len(rows) != height * (row + 1):
        raise ValueError(f"{len(rows)} bytes of pixels, {height * (row + 1)} wanted")
    return width, height, row, rows


def plate_has_ink(data):
    """Whether anything is not white on a plate: a TIFF file of 8 bits a pixel that is not compressed."""
    order = {b"II": "<", b"MM": ">"}[data[:2]]
    at, = struct.unpack_from(order + "I", data, 4)
    count, = struct.unpack_from(order + "H", data, at)
    tags = {}
    for i in range(count):
        tag, kind, number = struct.unpack_from(order + "HHI", data, at + 2 + 12 * i)
        code, size = {3: ("H", 2), 4: ("I", 4)}.get(kind, (None, 0))
        if code is None:
            continue
        where = at + 10 + 12 * i
        if number * size > 4:
            where, = struct.unpack_from(order + "I", data, where)
        tags[tag] = struct.unpack_from(f"{order}{number}{code}", data, where)
    if tags.get(259, (1,)) != (1,) or tags[258] != (8,):
        raise ValueError("a plate that is compressed, or not of 8 bits a pixel")
    return any(data[a:a + n].strip(b"\xff") for a, n in zip(tags[273], tags[279]))


def read_jpg(data):
    """Width and height, and how many bytes of scan there are."""
    if data[:2] != b"\xff\xd8" or data[-2:] != b"\xff\xd9":
        raise ValueError("not a whole JPEG file")
    at, size = 2, None
    while data[at + 1] != 0xda:  # until the scan
        if data[at] != 0xff:
            raise ValueError("segments that do not follow each other")
        if data[at + 1] in (0xc0, 0xc1, 0xc2):
            height, width = struct.unpack_from(">HH", data, at + 5)
            size = width, height
        at += 2 + struct.unpack_from(">H", data, at + 2)[0]
    return size, len(data) - at
