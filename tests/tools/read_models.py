# Readers of models that know nothing of popupc: binary glTF, glTF and FOLD. For tests.
import base64
import collections
import hashlib
import html.parser
import json
import math
import struct

COMPONENTS = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def read_glb(data):
    """The JSON of a binary glTF file and its binary chunk."""
    magic, version, size = struct.unpack_from("<4sII", data)
    if magic != b"glTF" or version != 2 or size != len(data):
        raise ValueError(f"header {magic!r}, version {version}, {size} bytes; the file has {len(data)}")
    at, chunks = 12, []
    while at < len(data):
        count, kind = struct.unpack_from("<I4s", data, at)
        chunks.append((kind, data[at + 8:at + 8 + count]))
        at += 8 + count
    if at != len(data) or [kind for kind, _ in chunks] != [b"JSON", b"BIN\0"] or len(data) % 4:
        raise ValueError("the lengths of the chunks do not add up")
    return json.loads(chunks[0][1]), chunks[1][1]


def read_gltf(data):
    document = json.loads(data)
    uri = document["buffers"][0]["uri"]
    head = "data:application/octet-stream;base64,"
    if not uri.startswith(head):
        raise ValueError(f"a buffer at {uri[:40]}")
    return document, base64.b64decode(uri[len(head):], validate=True)


def check_model(document, binary):
    """All that is named by number is there, all accessors lie within their views, and all vertices are there."""
    if document["asset"]["version"] != "2.0" or len(document["buffers"]) != 1:
        raise ValueError("not glTF 2.0 with one buffer")
    if not 0 <= len(binary) - document["buffers"][0]["byteLength"] < 4:
        yield f"the buffer has {len(binary)} bytes, not {document['buffers'][0]['byteLength']}"

    def values(number):
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        code, size = COMPONENTS[accessor["componentType"]]
        width = WIDTHS[accessor["type"]]
        step = view.get("byteStride", size * width)
        at, count = accessor.get("byteOffset", 0), accessor["count"]
        if count < 1 or at + (count - 1) * step + size * width > view["byteLength"]:
            raise ValueError(f"accessor {number} leaves its view")
        at += view.get("byteOffset", 0)
        if view["buffer"] != 0 or view.get("byteOffset", 0) + view["byteLength"] > len(binary):
            raise ValueError(f"the view of accessor {number} leaves the buffer")
        found = [struct.unpack_from(f"<{width}{code}", binary, at + i * step) for i in range(count)]
        if code == "f" and not all(math.isfinite(x) for row in found for x in row):
            raise ValueError(f"accessor {number} has a value that is no number")
        for name, choose in (("min", min), ("max", max)):
            if name in accessor and tuple(accessor[name]) != tuple(map(choose, *found, *found)):
                raise ValueError(f"accessor {number}: its {name} is not that of its values")
        return found

    triangles = 0
    for mesh in document["meshes"]:
        for part in mesh["primitives"]:
            counts = {len(values(number)) for number in part["attributes"].values()}
            indices = [row[0] for row in values(part["indices"])]
            if len(counts) != 1 or max(indices) >= min(counts):
                yield f"mesh {mesh.get('name')}: vertex {max(indices)} of {sorted(counts)}"
            if not 0 <= part["material"] < len(document["materials"]) or part.get("mode", 4) == 4 and len(indices) % 3:
                yield f"mesh {mesh.get('name')}: a material that there is not, or a third of a triangle"
            triangles += len(indices) // 3
    nodes, seen = document["nodes"], collections.Counter(document["scenes"][document["scene"]]["nodes"])
    for node in nodes:
        seen.update(node.get("children", []))
        if not 0 <= node.get("mesh", 0) < len(document["meshes"]):
            yield f"node {node.get('name')}: a mesh that there is not"
    if seen != collections.Counter(range(len(nodes))):
        yield "the nodes are not trees with each node once"
    for animation in document["animations"]:
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            times = [row[0] for row in values(sampler["input"])]
            if len(values(sampler["output"])) != len(times) or times != sorted(set(times)):
                yield "an animation whose keys are not in order, or not as many as its values"
            if not 0 <= channel["target"]["node"] < len(nodes):
                yield "an animation of a node that there is not"
    if not triangles:
        yield "a model without triangles"


class Page(html.parser.HTMLParser):
    """The elements of a page, and the texts of those that hold data, script and style."""

    def __init__(self):
        super().__init__()
        self.texts = collections.defaultdict(list)
        self.policy = None
        self.stack = []

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if values.get("http-equiv") == "Content-Security-Policy":
            self.policy = values["content"]
        self.stack.append(values.get("type", tag))

    def handle_endtag(self, tag):
        self.stack.pop()

    def handle_data(self, data):
        if self.stack and self.stack[-1] in ("application/json", "script", "style"):
            self.texts[self.stack[-1]].append(data)


def check_page(path):
    """A page that shows a model: its policy allows what stands in it, and its data are those of a scene."""
    page = Page()
    page.feed(path.read_bytes().decode("utf-8"))
    for kind in ("script", "style"):
        digest = base64.b64encode(hashlib.sha256("".join(page.texts[kind]).encode("utf-8")).digest()).decode("ascii")
        if f"{kind}-src 'sha256-{digest}';" not in page.policy:
            yield f"its policy does not allow its own {kind}"
    scene = json.loads("".join(page.texts["application/json"]))
    bodies = [body for card in scene["cards"] for body in card.get("plates", []) + card.get("standing", [])]
    if not bodies:
        yield "nothing is to be seen"
    for body in bodies:
        for mesh in body.get("meshes", []):
            if not scene["lists"][mesh["points"]] or not scene["lists"][mesh["triangles"]]:
                yield f"{body['name']} has a mesh without triangles"


class Book(html.parser.HTMLParser):
    """A page of text: what it has, and whether its elements are closed in the order in which they open."""

    VOID = {"meta", "link", "br", "img", "hr"}
    SHAPES = {"path", "rect", "image"}  # of SVG, which close themselves

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.faults, self.policy, self.style, self.pictures = [], [], "", "", 0
        self.names, self.links = set(), set()

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag == "script" or any(name.startswith("on") or name == "style" for name, _ in attributes):
            self.faults.append(f"it has a script or a style of its own: <{tag}>")
        if values.get("http-equiv") == "Content-Security-Policy":
            self.policy = values["content"]
        if "id" in values:
            self.names.add(values["id"])
        if values.get("href", "").startswith("#"):
            self.links.add(values["href"][1:])
        if values.get("role") == "img" and not values.get("aria-label"):
            self.faults.append("a picture says nothing to those who cannot see it")
        if tag == "image":
            data = base64.b64decode(values["href"].removeprefix("data:image/jpeg;base64,"), validate=True)
            self.pictures += data[:2] == b"\xff\xd8"
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> closes nothing")

    def handle_data(self, data):
        if self.open and self.open[-1] == "style":
            self.style += data


def check_book(path):
    """A page that says how a card is made."""
    page = Book()
    page.feed(path.read_bytes().decode("utf-8"))
    page.close()
    yield from page.faults
    if page.open:
        yield f"{page.open} are not closed"
    digest = base64.b64encode(hashlib.sha256(page.style.encode("utf-8")).digest()).decode("ascii")
    if page.policy != f"default-src 'none'; style-src 'sha256-{digest}'; img-src data:; base-uri 'none'; form-action 'none'":
        yield f"its policy is {page.policy}"
    if page.pictures == 0:
        yield "it has no picture"
    if not page.links or not page.links <= page.names:
        yield f"links lead nowhere: {sorted(page.links - page.names)}"


def check_fold(path):
    fold = json.loads(path.read_text("utf-8"))
    if fold["file_spec"] != 1.2:
        yield f"file_spec is {fold['file_spec']}, not 1.2"
    vertices, edges, faces = fold["vertices_coords"], fold["edges_vertices"], fold["faces_vertices"]
    for name, rows in (("edges_vertices", edges), ("faces_vertices", faces)):
        for number, row in enumerate(rows):
            if not all(isinstance(v, int) and 0 <= v < len(vertices) for v in row) or len(set(row)) != len(row):
                yield f"{name} {number} is {row}: there are {len(vertices)} vertices"
    sides = {frozenset(edge) for edge in edges}
    for number, face in enumerate(faces):
        if not all(frozenset(side) in sides for side in zip(face, face[1:] + face[:1])):
            yield f"face {number} has a side that is no edge"
    if len(sides) != len(edges):
        yield "an edge is there twice"
    frames = [fold, *fold.get("file_frames", [])]
    for number, frame in enumerate(frames):
        if frame is not fold and not 0 <= frame.get("frame_parent", 0) < len(frames):
            yield f"frame {number}: its parent {frame['frame_parent']} is none"
        for key, rows in frame.items():
            wanted = {"vertices": vertices, "edges": edges, "faces": faces}.get(key.split("_")[0])
            if wanted is not None and len(rows) != len(wanted):
                yield f"frame {number}: {key} has {len(rows)} members, not {len(wanted)}"
        for point in frame["vertices_coords"]:
            if len(point) not in (2, 3) or not all(math.isfinite(x) for x in point):
                yield f"frame {number}: a vertex {point}"
