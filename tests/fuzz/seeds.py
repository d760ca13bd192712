#!/usr/bin/env python3
"""Writes small inputs for the fuzz targets to begin with, one folder a target. Usage: tests/fuzz/seeds.py FOLDER"""
import gzip
import io
import json
import re
import struct
import sys
import zipfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OUT = Path(sys.argv[1])


def put(target, name, content):
    folder = OUT / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)


# A tetrahedron, in every mesh format.
CORNERS = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def meshes():
    rows = "".join(f"{x} {y} {z} {40 * i}\n" for i, (x, y, z) in enumerate(CORNERS))
    faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES)
    head = ("ply\nformat {}\ncomment made\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n")
    plys = {"text.ply": (head.format("ascii 1.0", 4) + rows + faces).encode()}
    for order, name in (("<", "little"), (">", "big")):
        body = b"".join(struct.pack(order + "fffB", *p, 9 * i) for i, p in enumerate(CORNERS))
        body += b"".join(struct.pack(order + "Biii", 3, *f) for f in FACES)
        plys[name + ".ply"] = head.format(f"binary_{name}_endian 1.0", 4).encode() + body
    strips = head.replace("element face", "element tristrips").format("ascii 1.0", 1) + rows + "6 0 1 2 3 0 1\n"
    plys["strips.ply"] = strips.encode()
    for name, content in plys.items():
        put("ply", name, content)
        put("attribute", name, content)
    put("obj", "quad.obj", "# c\nmtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 2 2 4\nvt 0 0\nvn 0 0 1\no a\n"
        "f 4/1/1 3/1/1 2/1/1 1/1/1\nf 1 2 5\nf 2//1 3//1 \\\n5//1\nf -3 -2 -1\nf 4/1 1/1 5/1\n")
    facets = [[CORNERS[i] for i in f] for f in FACES]
    put("stl", "text.stl", "solid t\n" + "".join(
        " facet normal 0 0 1\n  outer loop\n" + "".join(f"   vertex {x} {y} {z}\n" for x, y, z in f) +
        "  endloop\n endfacet\n" for f in facets) + "endsolid t\n")
    put("stl", "binary.stl", b"\0" * 80 + struct.pack("<I", 4) + b"".join(
        struct.pack("<12fH", 0, 0, 1, *sum(f, ()), 0) for f in facets))


def model(resources, items, attributes=""):
    return ('<?xml version="1.0"?><model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" '
            f'unit="millimeter" {attributes}><resources>{resources}</resources><build>{items}</build></model>')


def mesh_3mf(extra=""):
    return ("<mesh><vertices>" + "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in CORNERS) +
            "</vertices><triangles>" + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in FACES) +
            f"</triangles>{extra}</mesh>")


def node(kind, name, inputs, outputs, attributes=""):
    refs = "".join(f'<i:{t}ref identifier="{n}" ref="{r}"/>' for t, n, r in inputs)
    outs = "".join(f'<i:{t} identifier="{n}"/>' for t, n in outputs)
    into = f"<i:in>{refs}</i:in>" if inputs else ""
    return f'<i:{kind} identifier="{name}" {attributes}>{into}<i:out>{outs}</i:out></i:{kind}>'


def function(number, nodes, result, kind="scalar", inputs='<i:vector identifier="pos"/>'):
    return (f'<i:implicitfunction id="{number}" displayname="f"><i:in>{inputs}</i:in>{nodes}'
            f'<i:out><i:{kind}ref identifier="shape" ref="{result}"/></i:out></i:implicitfunction>')


def models():
    body = f'<object id="1" type="model">{mesh_3mf()}</object>'
    placed = body + ('<object id="2"><components><component objectid="1"/><component objectid="1" '
                     'transform="0 1 0 -1 0 0 0 0 1 9 8 7"/></components></object>')
    put("model", "plain.model", model(body, '<item objectid="1"/>'))
    relations = '<Relationships><Relationship Type="http://a/3dmodel" Target="/3D/a.model"/></Relationships>'
    for method, name in ((zipfile.ZIP_STORED, "stored.3mf"), (zipfile.ZIP_DEFLATED, "deflated.3mf")):
        package = io.BytesIO()
        with zipfile.ZipFile(package, "w", method) as archive:
            for part, text in (("_rels/.rels", relations), ("3D/a.model", model(body, '<item objectid="1"/>'))):
                archive.writestr(zipfile.ZipInfo(part), text, method)
        put("3mf", name, package.getvalue())
    put("model", "placed.model", model(placed, '<item objectid="2" transform="2 0 0 0 2 0 0 0 2 1 2 3"/>'))
    lattice = ('<b:beamlattice radius="0.5" minlength="0.001" cap="sphere" ballmode="mixed" ballradius="1" '
               'clippingmode="none"><b:beams><b:beam v1="0" v2="1" r1="0.4" r2="0.5" cap1="butt" cap2="hemisphere"/>'
               '<b:beam v1="1" v2="2"/></b:beams><b:balls><b:ball vindex="1" r="1"/></b:balls></b:beamlattice>')
    spaces = ('xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02" '
              'xmlns:v="http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01" '
              'xmlns:i="http://schemas.3mf.io/3dmanufacturing/implicit/2023/12" requiredextensions="b v i"')
    beams = model(f'<object id="1">{mesh_3mf(lattice)}</object>', '<item objectid="1"/>', spaces)
    one, two = [("scalar", "result")], [("vector", "result")]
    constant = '<i:constant identifier="c" value="1.5"><i:out><i:scalar identifier="value"/></i:out></i:constant>'
    ball = function(5, constant + node("length", "l", [("vector", "A", "inputs.pos")], one) + node(
        "subtraction", "s", [("scalar", "A", "l.result"), ("scalar", "B", "c.value")], one), "s.result")
    level = ('<object id="4"><v:levelset functionid="5" channel="shape" meshid="1" meshbboxonly="true" '
             'minfeaturesize="0.1" fallbackvalue="0" transform="0.5 0 0 0 0.5 0 0 0 0.5 0 0 0"/></object>')
    seeds = {"beams": beams, "level": model(body + ball + level, '<item objectid="4"/>', spaces)}
    # One node of each kind, by the types of its inputs.
    kinds = {"scalar": "abs acos asin atan ceil cos cosh exp floor fract log log10 log2 round sign sin sinh sqrt tan tanh"
             .split(), "scalar scalar": "addition atan2 division fmod max min mod multiplication pow subtraction".split(),
             "scalar scalar scalar": ["clamp"], "scalar scalar scalar scalar": ["select"], "vector vector": ["cross"]}
    split = node("decomposevector", "d", [("vector", "A", "inputs.pos")], [("scalar", a) for a in "xyz"])
    for types, names in kinds.items():
        ins = types.split()
        for name in names:
            refs = [(t, "ABCD"[k], "inputs.pos" if t == "vector" else "d." + "xyzx"[k])
                    for k, t in enumerate(ins)]
            if name == "clamp":
                refs = [("scalar", n, "d." + a) for n, a in zip(["A", "min", "max"], "xyz")]
            whole = function(5, split + node(name, "n", refs, one if ins[0] == "scalar" else two), "n.result",
                             "scalar" if ins[0] == "scalar" else "vector")
            seeds[name] = model(body + whole, '<item objectid="1"/>', spaces)
    calls = ball + function(
        2, '<i:constmat identifier="m" matrix="1 0 0 2 0 1 0 3 0 0 1 4 0 0 0 1"><i:out><i:matrix identifier="matrix"/>'
        '</i:out></i:constmat><i:constvec identifier="v" x="1" y="2" z="3"><i:out><i:vector identifier="vector"/></i:out>'
        '</i:constvec><i:constresourceid identifier="r" value="5"><i:out><i:resourceid identifier="value"/></i:out>'
        '</i:constresourceid>' + node("inverse", "n", [("matrix", "A", "m.matrix")], [("matrix", "result")]) +
        node("matvecmultiplication", "p", [("matrix", "A", "n.result"), ("vector", "B", "inputs.pos")], two) +
        node("functioncall", "k", [("resource", "functionID", "r.value"), ("vector", "pos", "p.result")],
             [("scalar", "shape")]), "k.shape")
    seeds["calls"] = model(body + calls, '<item objectid="1"/>', spaces)
    mesh_node = ('<i:constresourceid identifier="r" value="1"><i:out><i:resourceid identifier="value"/></i:out>'
                 '</i:constresourceid>' + node("mesh", "m", [("resource", "mesh", "r.value"), (
                     "vector", "pos", "inputs.pos")], [("scalar", "distance")]))
    seeds["mesh"] = model(body + function(3, mesh_node, "m.distance"), '<item objectid="1"/>', spaces)
    data = ('<v:volumedata id="7"><v:property name="p" functionid="5" channel="shape" required="true"/></v:volumedata>'
            f'<object id="8">{mesh_3mf()}</object>').replace("<mesh>", '<mesh volumeid="7">')
    seeds["data"] = model(ball + data, '<item objectid="8"/>', spaces)
    stack = ('<v:image3d id="6"><v:imagestack rowcount="3" columncount="4" sheetcount="1"><v:imagesheet path="/a.png"/>'
             '</v:imagestack></v:image3d><v:functionfromimage3d id="3" image3did="6" filter="linear" valueoffset="0" '
             'valuescale="2" tilestyleu="wrap" tilestylev="mirror" tilestylew="clamp"/>')
    seeds["image"] = model(body + stack, '<item objectid="1"/>', spaces)
    for name, text in seeds.items():
        put("volumetric", name + ".model", text)
    put("model", "beams.model", beams)


def png(width=4, height=3, color=0, rows=None):
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    raw = rows or b"".join(b"\0" + bytes(37 * i % 256 for i in range(channels * width)) for _ in range(height))
    parts = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, color, 0, 0, 0)), (b"IDAT", zlib.compress(raw)),
             (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)) for name, data in parts)


def pictures():
    for color in (0, 2, 4, 6):
        put("picture", f"color{color}.png", png(color=color))


def tiff(order, wide, pages=2):
    number, count, size = ("Q", "Q", 20) if wide else ("I", "H", 12)
    magic = {"<": b"II", ">": b"MM"}[order]
    bytes_ = magic + (struct.pack(order + "HHHQ", 43, 8, 0, 16) if wide else struct.pack(order + "HI", 42, 8))
    for page in range(pages):
        tags = [(256, 4, 2), (257, 4, 2), (258, 3, 8), (262, 3, 1), (273, 4, 0), (277, 3, 1), (278, 4, 2), (279, 4, 4)]
        at = len(bytes_)
        after = at + struct.calcsize(order + count) + size * len(tags) + struct.calcsize(order + number)
        bytes_ += struct.pack(order + count, len(tags))
        for tag, kind, value in tags:
            value = after if tag == 273 else value
            short = struct.pack(order + ("H" if kind == 3 else "I"), value)
            bytes_ += struct.pack(order + "HH" + number, tag, kind, 1) + short.ljust(8 if wide else 4, b"\0")
        bytes_ += struct.pack(order + number, after + 4 if page + 1 < pages else 0) + b"abcd"
    return bytes_


def volumes():
    for order, name in (("<", "little"), (">", "big")):
        put("tiff", name + ".tif", tiff(order, False))
        put("tiff", name + "_big.tif", tiff(order, True))
    head = "NRRD0004\n# made\ntype: {}\ndimension: 3\nsizes: 2 2 2\nencoding: {}\n{}\n"
    box = "space: left-posterior-superior\nspace directions: (1,0,0) (0,2,0) (0,0,3)\nspace origin: (0,0,0)\n"
    put("nrrd", "text.nrrd", head.format("float", "ascii", "spacings: 1 1 1\n") + "1 2 3.5 -4 5e0 6 7 nan\n")
    put("nrrd", "raw.nrrd", head.format("uchar", "raw", box).encode() + bytes(range(8)))
    put("nrrd", "short.nrrd", head.format("int16", "raw", "endian: big\n").encode() + bytes(range(16)))
    put("nrrd", "skip.nrrd", head.format("uint8", "raw", "line skip: 1\nbyte skip: -1\n").encode() + b"a\nbc" + bytes(8))
    put("nrrd", "four.nrrd", "NRRD0005\ntype: double\ndimension: 4\nsizes: 1 2 1 1\nencoding: raw\nendian: little\n"
        "kinds: scalar domain domain domain\nkey:=value\nunits: \"\" \"mm\" \"mm\" \"mm\"\n\n".encode() + struct.pack("<dd", 1, 2))
    packed = gzip.compress(struct.pack("<8f", *range(8)), mtime=0)
    put("nrrd", "packed.nrrd", head.format("float", "gzip", "endian: little\n").encode() + packed)
    put("nrrd", "list.nrrd", head.format("int8", "raw", "data file: LIST\n"))


def bricks():
    """The first byte is that of tests/fuzz/bricks_fuzz.cpp: whether the rest is packed there."""
    def payload(size, whole, samples, corners=(-1, 0, 1, 2, 4, 9)):
        numbers = struct.pack(f"<{len(samples)}f", *samples)
        return struct.pack("<3I6d", *size, *corners) + bytes(whole) + b"".join(numbers[i::4] for i in range(4))
    for name, packed in (("one", payload((1, 1, 1), [0], [0.5])), ("mixed", payload((9, 3, 2), [0, 1], [1] + [0.25] * 6)),
                         ("plate", payload((20, 9, 1), [0] * 5 + [1], [0, 0, 0, 1, 1, 0.5, 0.25, 0.125, float("nan")]))):
        put("bricks", name, b"\1" + packed)
        put("bricks", name + "_file", b"\0lamella bricks1\0" + zlib.compress(packed))


def patterns():
    """The first byte is that of tests/fuzz/pattern_fuzz.cpp: whether the rest is packed there."""
    def payload(corners, steps, numbers=(0.2, 5e-5, 1.7, 0.4, 0.5, 9, 3)):
        return (struct.pack("<7d8Q", *numbers, 2, 1, 3, 0, 1, 0, 1, len(corners)) + b"".join(struct.pack("<3q", *c) for c in corners) +
                b"".join(struct.pack("<729h", *s) for s in steps))
    for name, packed in (("none", payload([], [])), ("flat", payload([(0, 0, 0)], [[100] * 729])),
                         ("two", payload([(0, 0, 0), (-1, 2, 3)], [[k % 90 - 45 for k in range(729)], [-32768] * 700 + [7] * 29]))):
        put("pattern", name, b"\1" + packed)
        put("pattern", name + "_file", b"\0lamella pattern\0" + zlib.compress(packed))


def drawings():
    head = '<svg xmlns="http://www.w3.org/2000/svg" width="18mm" height="6mm" viewBox="-9 -3 18 6">'
    for i, shape in enumerate(['<path d="M -9 0 C -3 -4.2 3 -3.6 9 0 S 3 3.6 -9 0 Z"/>',
                               '<g transform="translate(1 2) rotate(30 1 1)"><rect x="1" width="4mm" height="3"/></g>',
                               '<path d="m0 0h4v3q1 1 2 2t-3-1a2 2 0 10-3-4z" style="fill:#000"/>',
                               '<circle r="2"/><ellipse cx="1" rx="3" ry="2" transform="matrix(1 0 .5 1 0 0)"/>',
                               '<polygon points="0,0 4,0 4,3" transform="scale(2) skewX(10)"/>']):
        put("svg", f"{i}.svg", head + shape + "</svg>")


def elements():
    put("elements", "two", "2,1,3,1,0,0.25,12.5,3,6,0,0\n1,0.1,2,-3,0.6,0,0.8,0,1.5\n0,1,0,0,1,0,0,0,1\n0,0,0,1,0,0.5\n")


def formulas():
    texts = ["x^2 + y*z - 3.5e-1", "min(x, y, max(z, 1)) < 2 ? sin(x) : cos(y)", "mod(x, 2) + atan2(y, x) - pow(z, 3)",
             "not (x < 1 and y >= 2) or z != 3", "clamp(x, -1, 1) * smoothstep(0, 1, y) / length(x, y, z)",
             "blend(exp(x), ln(abs(y)), floor(z)) - tau", "-x^-2 % 3", "sqrt(x) - 1/(y - y)", "step(x, y) && !z || x == y",
             "round(tan(x)) + ceil(asin(y / 3)) + sign(z) + log10(x) + acos(z) + square(y)"]
    for i, text in enumerate(texts):
        put("formula", f"{i}.txt", text)
    put("formula", "torus.vm", (ROOT / "examples/inputs/cut_torus.vm").read_bytes())
    unary = "neg abs square sqrt recip floor ceil round not sin cos tan asin acos atan exp ln".split()
    binary = "add sub mul div mod min max atan2 pow compare and or".split()
    put("formula", "all.vm", "# all\n_x var-x\n_y var-y\n_z var-z\n_c const -1.5\n" +
        "".join(f"_{name} {name} _x\n" for name in unary) + "".join(f"_{name} {name} _y _c\n" for name in binary))
    for i, name in enumerate(unary + binary):
        put("formula", f"{name}.vm", f"_x var-x\n_y var-z\n_r {name} _x{' _y' if i >= len(unary) else ''}\n")


def jobs():
    """The first byte is that of tests/fuzz/job_fuzz.cpp: how the rest is packed."""
    layer = b"\x55" + b"\xc8" + b"\x04"
    layer += bytes([~sum(layer[1:]) & 255])
    goo = b"V3.0" + b"\x07\0\0\0DLP\0" + b"program".ljust(32, b"\0") + b"1".ljust(24, b"\0") + bytes(24) + \
        b"machine".ljust(32, b"\0") + bytes(32) + b"resin".ljust(32, b"\0") + bytes(6)
    tail = struct.pack(">IHHH", 1, 4, 3, 0) + struct.pack(">fff", 8, 6, 100) + struct.pack(">ff", 0.05, 2) + bytes(29) + \
        struct.pack(">fI", 20, 3) + bytes(69) + struct.pack(">If", 60, 1) + bytes(16) + struct.pack(">IBH", 195477, 1, 2)
    end = bytes(3) + b"\x07\0\0\0DLP\0"
    whole = bytes(64) + b"\r\n" + struct.pack(">I", len(layer)) + layer + b"\r\n"
    put("job", "goo", b"\x03" + goo + tail + whole + end)
    sl1 = b"action = print\njobDir = part\nexpTime = 2\nexpTimeFirst = 20\nlayerHeight = 0.05\nnumFade = 2\nnumFast = 1\n" \
        b"numSlow = 0\nmaterialName = r\nprintTime = 90\nprinterModel = SL1\nusedMaterial = 0.4\n"
    put("job", "sl1", b"\x01" + sl1 + b"\0" + png())
    plate = json.dumps({"LayersCount": 1, "Path": "a", "PrintTime": 3, "TotalSolidArea": 2}).encode()
    put("job", "nanodlp", b"\x02" + plate + b"\0" + png(color=2))
    settings = json.dumps({"Settings": {"JobName": "a", "LayerThicknessMicrons": 50, "BurnInLayers": 1,
                                        "ModelExposureSec": 2, "FirstExposureSec": 9}}).encode()
    put("job", "ember", b"\x04" + settings + b"\0" + png())


def shards_and_journals():
    stamp = {"unfinished": "lamella", "version": 1, "identity": "identity", "settings": "settings", "first_layer": 2,
             "last_layer": 9}
    line = json.dumps(dict(stamp, last_layer=4))
    records = b"".join(struct.pack("<QII", 3, k, zlib.crc32(b"abc")) + b"abc" for k in (2, 3))
    put("shard", "two", b"lamella shard 1 " + line.encode() + b"\n" + records)
    rows = [json.dumps(stamp), '{"next":3,"size":2,"state":{"seconds":1.5}}', '{"next":4,"size":5,"state":null}']
    put("journal", "two", "abcdef\0" + "\n".join(rows) + "\n")


def replies():
    put("replies", "marlin", "start\nMarlin 2.1\nFIRMWARE_NAME:Marlin 2.1 SOURCE_CODE_URL:x\nCap:EMERGENCY_PARSER:1\n"
        "Cap:AUTOREPORT_TEMP:1\nok\nok N1 P15 B3\nok T:21.5 /210.0 B:60.0 /60.0 @:127\necho:busy: processing\n"
        "Error:Line Number is not Last Line Number+1, Last Line: 1\nResend: 2\nok\nrs N3\n//action:prompt_begin Change\n"
        "//action:prompt_button Yes\n//action:prompt_show\n//action:prompt_end\n T:20 /0 B:20 /0 W:3\nok\nok\n")
    put("replies", "oks", "start\n" + "".join(f"ok N{n} P15 B3\n" for n in range(60)))
    put("replies", "halt", "ok\nError:MINTEMP triggered\nError:Printer halted. kill() called!\n")
    put("replies", "grbl", "Grbl 1.1h ['$' for help]\n[VER:1.1h.20190830:]\n[OPT:V,15,128]\nok\n<Idle|MPos:0,0,0|Bf:15,128>\n"
        "ok\nerror:9\nALARM:1\n<Hold:0|MPos:0,0,0>\n[MSG:Reset]\n" + "ok\n" * 55 + "<Run|MPos:1,0,0|FS:1,1>\n")


def recipes():
    blocks = {path.stem: path.read_text() for path in ROOT.glob("examples/*.toml")}
    for page in ROOT.glob("docs/**/*.md"):
        for i, block in enumerate(re.findall(r"^```toml[^\n]*\n(.*?)^```", page.read_text(), re.S | re.M)):
            blocks[f"{page.stem}{i}"] = block
    # The target builds no recipe with these words, and has a part of its own.
    costly = re.compile("file|mesh|image|law|table|tests|profile|copies|scale")
    for name, block in blocks.items():
        put("recipe", f"{name}.toml", block)
        sections = re.split(r"^(?=\[)", block, flags=re.M)
        kept = [section for section in sections if not re.match(r"\[(part|printer|output)\]", section)]
        lines = [line for line in "".join(kept).splitlines() if not costly.search(line)]
        put("recipe", f"{name}_part.toml", "\n".join(lines) + "\n")
    words = set(re.findall(r"^\| `(\w+)` \|", (ROOT / "docs/reference/recipe.md").read_text(), re.M))
    words |= set(re.findall(r"^## (\[+[\w.]+\]+)", (ROOT / "docs/reference/recipe.md").read_text(), re.M))
    for values in re.findall(r"one of ([\w, ]+)", (ROOT / "docs/reference/recipe.md").read_text()):
        words |= set(values.split(", "))
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / "recipe.dict").write_text("".join(f'"{word}"\n' for word in sorted(words)))


def tables():
    """The first byte is that of tests/fuzz/tables_fuzz.cpp: what the rest is."""
    put("tables", "table.csv", "0z;number # heading\n0, 1.5\n1;2.5e0\n\n2\t-3\n7 , 7\n")
    laws = (ROOT / "materials/foam_laws.csv").read_text().splitlines()
    rows = [line for line in laws if not line.startswith("#")]
    put("tables", "laws.csv", "1" + "\n".join(rows[:9]) + "\n")
    put("tables", "materials.toml", "2" + "\n".join((ROOT / "materials/materials.toml").read_text().splitlines()[4:18]))


def requests():
    raster = {"columns": 8, "rows": 6, "lines": 4, "x": -2, "y": -2, "pitch_x": 0.5, "pitch_y": 0.6}
    lines = [{"id": 1, "method": "contours", "job": 1, "z": 0.25, "what": "part", "tolerance": 0.1},
             {"id": "a", "method": "coverage", "job": 1, "layer": 2, **raster},
             {"method": "runs", "job": 1, "layer": 0, "what": "both", **raster},
             {"method": "fill", "job": 1, "z": 0.5, "polygons": [[0, 0, 1, 0, 1, 1], [-1, -1, 0, -1, 0, 0, -1, 0]]},
             {"method": "open", "name": "a.toml", "text": "[part]\nshape = \"none\"\n", "set": {"layers.height": 0.2}},
             {"method": "run", "job": 1, "first": 0, "last": 2}, {"method": "close", "job": 1}, {"method": "end"}]
    for i, line in enumerate(lines):
        put("requests", str(i), json.dumps(line))
    put("requests", "all", "\n".join(json.dumps(line) for line in lines))


for write in (meshes, models, pictures, volumes, bricks, patterns, drawings, elements, formulas, jobs,
              shards_and_journals, replies, recipes, tables, requests):
    write()
