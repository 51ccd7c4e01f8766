#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A second reader of `.spa` files, written from formats/SPA.md with nothing but the standard library.

Prints every decoded value of a file as text. It shares no code with the C++ reader, so that the two agreeing
says that the specification is right. Files with compression need the `zstd` command.

    read_spa.py FILE              prints
    read_spa.py FILE --compare    reads the same text by another reader on stdin and compares the numbers
"""

import math
import struct
import subprocess
import sys

IDENTIFIER = bytes.fromhex("AB535041204D61700D0A1A0A")
MINOR = 3  # the version of the specification
MASK = (1 << 64) - 1


class Refused(Exception):
    """The file breaks a rule of the specification."""


def require(condition, issue, what=""):
    if not condition:
        raise Refused(f"SPA-{issue} {what}")


# XXH3, 64 bits, seed 0 (section 2, "Checksums"), after the xxHash specification.

SECRET = bytes.fromhex(
    "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221"
    "b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8"
    "a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb"
    "170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e"
)
P32 = (0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D)
P64 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5)
PMX = (0x165667919E3779F9, 0x9FB21C651E98DF25)


def u32(data, at):
    return struct.unpack_from("<I", data, at)[0]


def u64(data, at):
    return struct.unpack_from("<Q", data, at)[0]


def rotate(value, bits):
    return (value << bits | value >> (64 - bits)) & MASK


def fold(a, b):
    product = a * b
    return (product & MASK) ^ (product >> 64)


def avalanche(h):
    h = ((h ^ (h >> 37)) * PMX[0]) & MASK
    return h ^ (h >> 32)


def avalanche64(h):
    h = ((h ^ (h >> 33)) * P64[1]) & MASK
    h = ((h ^ (h >> 29)) * P64[2]) & MASK
    return h ^ (h >> 32)


def mix16(data, at, secret_at):
    return fold(u64(data, at) ^ u64(SECRET, secret_at), u64(data, at + 8) ^ u64(SECRET, secret_at + 8))


def xxh3_short(data):
    n = len(data)
    if n == 0:
        return avalanche64(u64(SECRET, 56) ^ u64(SECRET, 64))
    if n <= 3:
        combined = data[n - 1] | n << 8 | data[0] << 16 | data[n >> 1] << 24
        return avalanche64(combined ^ u32(SECRET, 0) ^ u32(SECRET, 4))
    if n <= 8:
        h = (u32(data, n - 4) + (u32(data, 0) << 32)) ^ (u64(SECRET, 8) ^ u64(SECRET, 16))
        h ^= rotate(h, 49) ^ rotate(h, 24)
        h = (h * PMX[1]) & MASK
        h ^= (h >> 35) + n
        h = (h * PMX[1]) & MASK
        return h ^ (h >> 28)
    low = u64(data, 0) ^ u64(SECRET, 24) ^ u64(SECRET, 32)
    high = u64(data, n - 8) ^ u64(SECRET, 40) ^ u64(SECRET, 48)
    swapped = int.from_bytes(low.to_bytes(8, "little"), "big")
    return avalanche((n + swapped + high + fold(low, high)) & MASK)


def xxh3_middle(data):
    n = len(data)
    h = n * P64[0]
    if n <= 128:
        for i in reversed(range((n - 1) // 32 + 1)):
            h += mix16(data, 16 * i, 32 * i) + mix16(data, n - 16 * (i + 1), 32 * i + 16)
        return avalanche(h & MASK)
    for i in range(8):
        h += mix16(data, 16 * i, 16 * i)
    h = avalanche(h & MASK)
    for i in range(8, n // 16):
        h += mix16(data, 16 * i, 16 * (i - 8) + 3)
    return avalanche((h + mix16(data, n - 16, 136 - 17)) & MASK)


def xxh3_long(data):
    n = len(data)
    acc = [P32[2], P64[0], P64[1], P64[2], P64[3], P32[1], P64[4], P32[0]]

    def stripe(at, secret_at):
        for i in range(8):
            value = u64(data, at + 8 * i)
            keyed = value ^ u64(SECRET, secret_at + 8 * i)
            acc[i ^ 1] = (acc[i ^ 1] + value) & MASK
            acc[i] = (acc[i] + (keyed & 0xFFFFFFFF) * (keyed >> 32)) & MASK

    stripes = (len(SECRET) - 64) // 8
    for number in range((n - 1) // 64):
        stripe(64 * number, 8 * (number % stripes))
        if number % stripes == stripes - 1:
            for i in range(8):
                a = acc[i]
                acc[i] = ((a ^ (a >> 47) ^ u64(SECRET, len(SECRET) - 64 + 8 * i)) * P32[0]) & MASK
    stripe(n - 64, len(SECRET) - 64 - 7)
    h = n * P64[0]
    for i in range(4):
        h += fold(acc[2 * i] ^ u64(SECRET, 11 + 16 * i), acc[2 * i + 1] ^ u64(SECRET, 19 + 16 * i))
    return avalanche(h & MASK)


def xxh3(data):
    if len(data) <= 16:
        return xxh3_short(data)
    return xxh3_middle(data) if len(data) <= 240 else xxh3_long(data)


# Element formats (sections 4 and 7).

FORMATS = {  # value: (name, section type, components, bytes of a component)
    1: ("rgba8", b"COLR", 4, 1),
    2: ("u8", b"DPTH", 1, 1),
    3: ("u16", b"DPTH", 1, 2),
    4: ("f32", b"DPTH", 1, 4),
    5: ("oct8", b"NRML", 2, 1),
    6: ("oct16", b"NRML", 2, 2),
    7: ("rgb8", b"NRML", 3, 1),
}


def sign(v):
    return -1.0 if v < 0 else 1.0


def normalized(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def unfold(a, b):
    z = 1 - abs(a) - abs(b)
    if z >= 0:
        return normalized((a, b, z))
    return normalized(((1 - abs(b)) * sign(a), (1 - abs(a)) * sign(b), z))


def decode_element(name, data):
    if name == "rgba8":
        return tuple(data)
    if name == "u8":
        return (data[0] / 255,)
    if name == "u16":
        return (struct.unpack("<H", data)[0] / 65535,)
    if name == "f32":
        return struct.unpack("<f", data)
    if name == "oct8":
        return unfold(*(c / 127 for c in struct.unpack("<2b", data)))
    if name == "oct16":
        return unfold(*(c / 32767 for c in struct.unpack("<2h", data)))
    if data == b"\0\0\0":
        return (0.0, 0.0, 0.0)
    return normalized(tuple(c / 127.5 - 1 for c in data))


def unfilter(data, width, height, components, size):
    samples = width * height
    bits = 8 * size
    top = (1 << bits) - 1
    out = bytearray(len(data))
    for c in range(components):
        v = [0] * samples
        for i in range(samples):
            z = sum(data[(c * size + b) * samples + i] << (8 * b) for b in range(size))
            d = (z >> 1) ^ (top if z & 1 else 0)
            left = v[i - 1] if i % width else 0
            above = v[i - width] if i >= width else 0
            corner = v[i - width - 1] if i % width and i >= width else 0
            v[i] = (d + left + above - corner) & top
            at = (i * components + c) * size
            out[at : at + size] = v[i].to_bytes(size, "little")
    return bytes(out)


def decompress(data):
    done = subprocess.run(["zstd", "-dc"], input=data, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    require(done.returncode == 0, 403, done.stderr.decode(errors="replace"))
    return done.stdout


# The file (sections 1 to 5), read as section 12 says.


SINCE = {b"PART": 0, b"META": 0, b"DPTH": 0, b"NRML": 0, b"COLR": 0, b"MIXD": 1, b"FOLD": 2, b"BIND": 3}  # minor versions


class Entry:
    def __init__(self, data):
        self.type = data[:4]
        (self.flags, self.part, self.layer, self.side, self.scheme, self.format, self.width, self.height) = (
            struct.unpack_from("<IIHHIIII", data, 4)
        )
        self.offset, self.stored, self.raw, self.checksum = struct.unpack_from("<QQQQ", data, 32)


class Part:
    def __init__(self, data, minor):
        numbers = struct.unpack_from("<13d", data, 0)
        self.center, self.radius, self.frame = numbers[:3], numbers[3], numbers[4:]
        self.mapping, self.layers, self.node, self.joint = struct.unpack_from("<IIii", data, 104)
        self.errors = struct.unpack_from("<8f", data, 120)
        require(all(abs(v) <= 2.0**60 for v in numbers) and self.radius >= 2.0**-60, 302)
        require(self.mapping in (1, 2), 304)
        require(1 <= self.layers <= 65535, 305)
        flags = u32(data, 152)
        require(minor > 0 or flags == 0, 308)
        require(minor > MINOR or flags & ~1 == 0, 309)
        require(minor > MINOR or not any(data[156:192]), 308)
        self.center_inside = flags & 1


def read(data):
    """Returns parts, images as {(part, layer, side, type): (entry, raw bytes)}, metadata."""
    require(data[:12] == IDENTIFIER, 102)
    require(len(data) >= 64, 101)
    major, minor, length, count = struct.unpack_from("<HHQI", data, 12)
    require(major == 1, 104)
    require(len(data) >= length, 105)
    require(len(data) <= length, 106)
    end = 64 + 64 * count
    require(end <= length, 107)
    require(xxh3(data[:56] + bytes(8) + data[64:end]) == u64(data, 56), 108)
    require(minor > MINOR or not any(data[28:56]), 109)
    entries = [Entry(data[64 + 64 * i : 128 + 64 * i]) for i in range(count)]
    require(count > 0 and entries[0].type == b"PART", 213)

    parts, images, metadata = [], {}, b""
    for entry in entries:
        start = (end + 63) // 64 * 64
        require(entry.offset == start, 205)
        require(not any(data[end:start]), 401)
        end = start + entry.stored
        require(end <= length, 207)
        stored = data[start:end]
        require(xxh3(stored) == entry.checksum, 402)
        if minor < SINCE.get(entry.type, minor + 1):
            require(not entry.flags & 1, 201, repr(entry.type))
            continue
        require(entry.scheme in (0, 1, 2), 209)
        raw = decompress(stored) if entry.scheme else stored
        require(len(raw) == entry.raw, 404 if entry.scheme else 211)
        if entry.type == b"PART":
            require(raw and len(raw) % 192 == 0, 301)
            parts = [Part(raw[192 * i : 192 * (i + 1)], minor) for i in range(len(raw) // 192)]
        elif entry.type == b"META":
            metadata = raw
        elif entry.type in (b"MIXD", b"FOLD", b"BIND"):
            fields = entry.layer or entry.side or entry.format or entry.width or entry.height
            require(not fields, {b"MIXD": 222, b"FOLD": 225, b"BIND": 228}[entry.type])
            require(entry.type != b"BIND" or entry.raw == 96, 230)
            images[entry.part, 0, 0, entry.type] = (entry, raw)
        else:
            name, kind, components, size = FORMATS[entry.format]
            require(kind == entry.type, 217)
            require(entry.raw == entry.width * entry.height * components * size, 219)
            if entry.scheme == 2:
                raw = unfilter(raw, entry.width, entry.height, components, size)
            images[entry.part, entry.layer, entry.side, entry.type] = (entry, raw)
    require(end == length, 208)
    for part, _, _, kind in images:
        octahedral = part < len(parts) and parts[part].mapping == 2
        require(kind != b"MIXD" or octahedral, 223)
        require(kind != b"BIND" or part < len(parts) and parts[part].node >= 0, 229)
        require(kind != b"FOLD" or octahedral and (part, 0, 0, b"MIXD") in images, 226)
    return parts, images, metadata


# Directions and geometry (sections 5 and 6).


def direction(mapping, x, y, width, height):
    if mapping == 1:
        phi = 2 * math.pi * (x + 0.5) / width - math.pi
        theta = math.pi * (y + 0.5) / height
        return (math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi))
    n = width - 1
    require(width == height and n >= 2 and n % 2 == 0, 218)
    return unfold(2 * x / n - 1, 1 - 2 * y / n)


def to_object_space(part, q):
    return tuple(part.center[i] + sum(part.frame[3 * i + k] * q[k] for k in range(3)) for i in range(3))


def mixed_triangles(part, images, index):
    """Lines for the triangles of a part, if it says which are mixed (section 9)."""
    if (index, 0, 0, b"MIXD") not in images:
        return
    raw = images[index, 0, 0, b"MIXD"][1]
    depth = images[index, 0, 0, b"DPTH"][0]
    n = depth.width - 1
    require(len(raw) == n * n // 4, 224)
    present = []  # for each depth image, whether there is a surface
    for (owner, _, _, kind), (entry, codes) in images.items():
        if owner == index and kind == b"DPTH":
            size = FORMATS[entry.format][3]
            present.append([any(codes[size * i : size * (i + 1)]) for i in range((n + 1) * (n + 1))])
    yield f"mixed {index} {n}"
    for y in range(n):
        for x in range(n):
            xn, xf = (x + 1, x) if x < n / 2 else (x, x + 1)
            yn, yf = (y + 1, y) if y < n / 2 else (y, y + 1)
            for f, corners in enumerate([((xn, yn), (xn, yf), (xf, yn)), ((xf, yf), (xn, yf), (xf, yn))]):
                i = 2 * (y * n + x) + f
                mixed = raw[i // 8] >> i % 8 & 1
                for surface in present:
                    require(mixed or len({surface[cy * (n + 1) + cx] for cx, cy in corners}) == 1, 506)
                u = [c for cx, cy in corners for c in direction(part.mapping, cx, cy, n + 1, n + 1)]
                yield f"{mixed} " + " ".join(map(number, u))


def depth_images(images, index):
    """The decoded depths of a part by layer and side (0 outer, 1 inner)."""
    depths = {}
    for (owner, layer, side, kind), (entry, codes) in images.items():
        if owner == index and kind == b"DPTH":
            name, _, _, size = FORMATS[entry.format]
            depths[layer, side] = [decode_element(name, codes[i : i + size])[0] for i in range(0, len(codes), size)]
    return depths


def triangles_at(n, ends):
    """The bits of the triangles that have both samples as corners (section 9)."""
    for y in range(min(y for _, y in ends) - 1, max(y for _, y in ends) + 1):
        for x in range(min(x for x, _ in ends) - 1, max(x for x, _ in ends) + 1):
            if 0 <= x < n and 0 <= y < n:
                xn, xf = (x + 1, x) if x < n / 2 else (x, x + 1)
                yn, yf = (y + 1, y) if y < n / 2 else (y, y + 1)
                for f, corner in enumerate([(xn, yn), (xf, yf)]):
                    if set(ends) <= {corner, (xn, yf), (xf, yn)}:
                        yield 2 * (y * n + x) + f


def fold_records(part, images, index):
    """Lines for the fold records of a part, if it has any (section 10)."""
    if (index, 0, 0, b"FOLD") not in images:
        return
    raw, mixed = (images[index, 0, 0, kind][1] for kind in (b"FOLD", b"MIXD"))
    n = images[index, 0, 0, b"DPTH"][0].width - 1
    require(n <= 16384, 226)
    count = len(raw) // 10
    require(raw and len(raw) % 10 == 0 and count <= 64 * 3 * (n + 1) ** 2, 227)
    depths = depth_images(images, index)
    yield f"folds {index} {count}"
    edge, taken_from = 0, None
    for i in range(count):
        record = raw[i::count]
        step, bits, place, *cut = struct.unpack("<IBBHH", record)
        edge += step
        kind, x, y = edge % 3, edge // 3 % (n + 1), edge // 3 // (n + 1)
        require(y <= n and (kind == 1 or x < n) and (kind == 0 or y < n), 507)
        xn, xf = (x + 1, x) if x < n / 2 else (x, x + 1)
        yn, yf = (y + 1, y) if y < n / 2 else (y, y + 1)
        ends = [((x, y), (x + 1, y)), ((x, y), (x, y + 1)), ((xn, yf), (xf, yn))][kind]
        if taken_from != edge:
            taken_from = edge
            triangles = list(triangles_at(n, ends))
            require(all(mixed[t // 8] >> t % 8 & 1 for t in triangles), 510)
            border = any(all(sample[axis] == side for sample in ends) for axis in (0, 1) for side in (0, n))
            assert len(triangles) == (1 if border else 2)
            left = [sum(1 for depth in depths.values() if depth[sy * (n + 1) + sx] > 0) for sx, sy in ends]
        index_at, end, pair = bits & 63, bits >> 6 & 1, bits >> 7
        require(index_at + pair < left[end], 508)
        left[end] -= 1 + pair
        require(cut[0] != 0 and (cut[1] != 0) == bool(pair), 509)
        p, q = ends[end], ends[1 - end]
        u = direction(part.mapping, *(p[k] + (place + 1) / 256 * (q[k] - p[k]) for k in (0, 1)), n + 1, n + 1)
        values = []
        for code in cut[: 1 + pair]:
            values += [code / 65535, *to_object_space(part, tuple(code / 65535 * part.radius * c for c in u))]
        integers = (edge, end, pair, index_at, place, *ends[0], *ends[1])
        yield " ".join(map(str, integers)) + " " + " ".join(map(number, values))


def number(value):
    return "nan" if value != value else f"{value:.9g}"


def lines(data):
    parts, images, metadata = read(data)
    yield "metadata " + metadata.hex()
    for index, part in enumerate(parts):
        fields = part.center + (part.radius,) + part.frame + part.errors
        yield f"part {index} {part.mapping} {part.layers} {part.node} {part.joint} {part.center_inside} " + " ".join(map(number, fields))
        for layer in range(part.layers):
            for side in (0, 1):
                for kind in (b"DPTH", b"NRML", b"COLR"):
                    if (index, layer, side, kind) not in images:
                        require(side == 1, 220)
                        continue
                    entry, raw = images[index, layer, side, kind]
                    name, _, components, size = FORMATS[entry.format]
                    yield f"image {kind.decode()} {index} {layer} {side} {name} {entry.width} {entry.height}"
                    step = components * size
                    for i in range(entry.width * entry.height):
                        values = decode_element(name, raw[step * i : step * (i + 1)])
                        if kind == b"DPTH":
                            u = direction(part.mapping, i % entry.width, i // entry.width, entry.width, entry.height)
                            q = tuple(values[0] * part.radius * c for c in u)
                            values = values + u + to_object_space(part, q)
                        yield " ".join(map(number, values))
        if (index, 0, 0, b"BIND") in images:
            bind = struct.unpack("<12d", images[index, 0, 0, b"BIND"][1])
            require(all(abs(v) <= 2.0**60 for v in bind), 310)
            yield f"bind {index} " + " ".join(map(number, bind))
        yield from mixed_triangles(part, images, index)
        yield from fold_records(part, images, index)


def equal(a, b):
    if a == b:
        return True
    try:
        return abs(float(a) - float(b)) <= 1e-6 * max(1.0, abs(float(b)))
    except ValueError:
        return False


def compare(mine, theirs):
    """Prints the first difference; returns the exit code."""
    count = 0
    for count, line in enumerate(mine, 1):
        other = theirs.readline().rstrip("\n")
        a, b = line.split(), other.split()
        if len(a) != len(b) or not all(map(equal, a, b)):
            print(f"line {count} differs\n  here:  {line}\n  there: {other}")
            return 1
    if theirs.readline():
        print("there is more there")
        return 1
    print(f"{count} lines agree")
    return 0 if count > 1 else 1


def main(arguments):
    with open(arguments[0], "rb") as stream:
        data = stream.read()
    try:
        if arguments[1:] == ["--compare"]:
            return compare(lines(data), sys.stdin)
        for line in lines(data):
            print(line)
    except Refused as refused:
        print(f"{arguments[0]}: {refused}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
