#!/usr/bin/env python3
"""What a hostile or unlucky user would try: hostile.py PETRICHOR [--seed N] [--all] [--only WORD]

Each class is tried with seeds; for each there is a row: how many were tried, how many were answered
(exit code 0 or 2, in time, within memory, nothing left behind), and the most memory and time one took.
The quick part takes about a minute on two cores; --all more. Exit code 1 when one was not answered.
Needs only Python's own library; rendering cases are left out, with a word, where there is no device.
"""
import argparse, json, os, random, resource, shutil, signal, struct, subprocess, sys, tempfile, threading
import time, zlib
from pathlib import Path

LIMIT_S, LIMIT_MIB = 30.0, 1500


class Table:
    def __init__(self, only):
        self.rows, self.problems, self.only = {}, [], only

    def note(self, name, good, mib, seconds, what):
        tried, answered, most_mib, most_s = self.rows.get(name, (0, 0, 0, 0.0))
        self.rows[name] = (tried + 1, answered + good, max(most_mib, mib), max(most_s, seconds))
        if not good:
            self.problems.append(f"{name}: {what}")

    def print(self):
        print(f"{'class':<34}{'tried':>7}{'answered':>10}{'MiB at most':>13}{'s at most':>11}")
        for name, (tried, answered, mib, seconds) in self.rows.items():
            print(f"{name:<34}{tried:>7}{answered:>10}{mib:>13}{seconds:>11.2f}")
        for problem in self.problems[:40]:
            print("NOT ANSWERED", problem)


class Lateness(threading.Thread):
    """How much longer half a second takes while others have the machine: the latest that a sleep of 5 ms
    ended, here and in a thread of lowest priority (the driver keeps one, and a process is gone when its last
    thread is), and how much longer the end itself takes: 0.2 s of work, and a quarter of a second for each
    GiB that the kernel takes back, which no program can hurry."""

    def __init__(self):
        super().__init__(daemon=True)
        self.done, self.overslept, self.wall, self.cpu, self.background_s = False, 0.0, 0.0, 0.0, 0.0
        self.background = threading.Thread(target=self.run_background, daemon=True)
        self.background.start()
        self.start()

    def run_background(self):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), 19)
        while not self.done:
            start = time.monotonic()
            time.sleep(0.005)
            self.background_s = max(self.background_s, time.monotonic() - start - 0.005)

    def run(self):
        while not self.done:
            start = time.monotonic()
            time.sleep(0.005)
            self.overslept = max(self.overslept, time.monotonic() - start - 0.005)
            start, before = time.monotonic(), time.thread_time()
            while time.thread_time() - before < 0.005:
                pass
            self.cpu += time.thread_time() - before
            self.wall += time.monotonic() - start

    def seconds(self, mib):
        self.done = True
        self.join()
        self.background.join()
        stretch = max(1.0, self.wall / self.cpu) if self.cpu else 1.0
        return self.overslept + self.background_s + 0.2 * (stretch - 1.0) + 0.25 * mib / 1024 * stretch


class Run:
    """One run: exit code, output, wall seconds, peak MiB of the process."""

    def __init__(self, program, words, folder, stdout=None, interrupt_s=None, kill_s=None,
                 file_limit=None, sig=signal.SIGTERM):
        def limits():
            if file_limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        start = time.monotonic()
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            self.child = subprocess.Popen([program, *words], cwd=folder, stdin=subprocess.DEVNULL,
                                          stdout=stdout or out, stderr=err, preexec_fn=limits)
            self.late_s, self.machine_late_s, asked, lateness = 0.0, 0.0, None, None
            while True:
                pid, status, usage = os.wait4(self.child.pid, os.WNOHANG)
                now = time.monotonic() - start
                if pid:
                    break
                if interrupt_s is not None and asked is None and now > interrupt_s:
                    lateness = Lateness()
                    os.kill(self.child.pid, sig)
                    asked = now
                if kill_s is not None and now > kill_s or now > 4 * LIMIT_S:
                    os.kill(self.child.pid, signal.SIGKILL)
                    kill_s = 1e9
                time.sleep(0.005)
            self.seconds, self.mib = now, usage.ru_maxrss // 1024
            if asked is not None:
                self.late_s, self.machine_late_s = now - asked, lateness.seconds(self.mib)
            self.code = os.waitstatus_to_exitcode(status)
            self.child.returncode = self.code
            for file in (out, err):
                file.seek(0)
            self.out, self.err = out.read(), err.read()

    def answered(self, codes=(0, 2)):
        busy = max(1.0, os.getloadavg()[0] / (os.cpu_count() or 1))
        return (self.code in codes and self.seconds < LIMIT_S * busy and self.mib < LIMIT_MIB
                and b"internal error" not in self.err and b"\x1b" not in self.err)

    def what(self):
        words = self.err.decode("utf-8", "replace").replace("\n", " ")[:160]
        return f"exit {self.code}, {self.seconds:.1f} s, {self.mib} MiB: {words}"


def png(width, height, depth, color, row):
    """A PNG of equal rows, packed by pieces: the test itself stays small."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    packer, packed = zlib.compressobj(6), []
    line = b"\0" + row
    for _ in range(height):
        packed.append(packer.compress(line))
    packed.append(packer.flush())
    head = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", b"".join(packed)) +
            chunk(b"IEND", b""))


def scene(images, primitives=1, name="floor", nodes=1):
    """A floor with the images as base colours, one material each, as a .gltf with a .bin beside it."""
    corners = [(-2, 0, -2), (2, 0, -2), (2, 0, 2), (-2, 0, 2)]
    data = b"".join(struct.pack("<3f", *c) for c in corners)
    data += b"".join(struct.pack("<2f", *uv) for uv in [(0, 0), (1, 0), (1, 1), (0, 1)])
    data += struct.pack("<6H", 0, 2, 1, 0, 3, 2)
    materials = [{"name": name, "pbrMetallicRoughness": {"baseColorTexture": {"index": i}}}
                 for i in range(len(images))] or [{"name": name}]
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(nodes))}],
        "nodes": [{"mesh": 0, "name": name, "translation": [i % 50, 0, i // 50]}
                  for i in range(nodes)],
        "meshes": [{"name": name, "primitives": [dict(primitive, material=i % len(materials))
                                                 for i in range(max(primitives, len(images)))]}],
        "materials": materials,
        "buffers": [{"uri": "floor.bin", "byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
             "min": [-2, 0, -2], "max": [2, 0, 2]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}]}
    if images:
        document["images"] = [{"uri": image} for image in images]
        document["textures"] = [{"source": i} for i in range(len(images))]
    return document, data


def mutated(data, random_):
    data = bytearray(data)
    for _ in range(random_.choice((1, 1, 2, 8, 40))):
        at = random_.randrange(max(1, len(data)))
        kind = random_.randrange(5)
        if kind == 0 and data:
            data[at] = random_.randrange(256)
        elif kind == 1 and data:
            data[at] ^= 1 << random_.randrange(8)
        elif kind == 2:
            del data[at:at + random_.randrange(64)]
        elif kind == 3:
            data[at:at] = data[at:at + random_.randrange(64)]
        else:
            data[at:at] = random_.choice((b"1e999", b"-1", b"\0", b"\xff\xfe", b"99999999999", b'"', b"[" * 99))
    return bytes(data)


class Hostile:
    def __init__(self, options, folder):
        self.program, self.folder, self.all = os.path.abspath(options.program), folder, options.all
        self.random, self.table = random.Random(options.seed), Table(options.only)
        report = Run(self.program, ["doctor", "--json"], folder)
        self.device = report.code == 0
        if not self.device:
            print("no device that renders: those cases stop before the first frame")

    def write(self, name, data):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return name

    def run(self, words, **how):
        return Run(self.program, words, self.folder, **how)

    def expect(self, name, words, codes=(0, 2), word=None, **how):
        run = self.run(words, **how)
        good = run.answered(codes) and (word is None or word.encode() in run.err + run.out)
        self.table.note(name, good, run.mib, run.seconds, f"{words!r}: {run.what()}")
        return run

    def put_scene(self, file, images, **how):
        document, data = scene(images, **how)
        self.write("floor.bin", data)
        return self.write(file, json.dumps(document))

    RENDER = ["--size", "32x18", "--samples", "1", "--count", "1", "--no-film", "--no-exr"]

    def leftovers(self, folder):
        root = self.folder / folder
        return [str(p) for p in root.rglob(".petrichor-[0-9a-f]*")] if root.exists() else []

    # --- the classes ---

    def toml_depth(self):
        texts = {"dots": ".".join(["a"] * 40000) + "=1", "header": "[" + ".".join(["a"] * 40000) + "]",
                 "brackets": "a=" + "[" * 100000, "tables": "a=" + "{a=" * 100000,
                 "quoted": ".".join(['"a"'] * 40000) + "=1", "large": "a=1\n" * 3000000}
        for kind, text in texts.items():
            file = self.write(f"deep_{kind}.toml", text)
            for words in (["render", file], ["simulate", file], ["texture", "build", file, "-o", "o"],
                          ["simulate", "storm", "--params", file]):
                self.expect("TOML depth and size", words, codes=(2,))

    def names(self):
        csv = b"time_s,temperature_c,rainfall\n0,5,0\n10,4,1\n"
        for raw in (b"b\xff.csv", b"\x1b[2J.csv", b"new\nline.csv", b"it's \"so\".csv", b"-dash.csv",
                    "水.csv".encode(), b"\xc2\x9b31m.csv"):
            name = os.fsdecode(raw)
            (self.folder / name).write_bytes(csv)
            for words in ([f"./{name}", "-o", "a.csv"], [f"./{name}", "--json"],
                          [f"./{name}", "-o", "a.html"], [f"./{name}", "-o", "a.svg"]):
                self.expect("names", ["simulate", *words], codes=(0,))
        picture = png(8, 8, 8, 2, b"\x80\x40\x20" * 8)
        for raw in (b"w\xff.png", b"w\x1b.png"):
            (self.folder / os.fsdecode(raw)).write_bytes(picture)
            self.expect("names", ["texture", "inspect", os.fsdecode(raw), "--json"], codes=(0,))
        self.expect("names", ["init", "q", "--force", "--scene", 'we"ird\\.glb'], codes=(0,))
        self.expect("names", ["render", "q.toml"], codes=(2,), word="we\"ird")

    def not_files(self):
        os.mkfifo(self.folder / "pipe")
        for target in ("pipe", "/dev/zero", "/dev/tty", "."):
            for words in (["render", target], ["simulate", target], ["texture", "inspect", target],
                          ["simulate", "storm", "--params", target],
                          ["simulate", "storm", "--resume", target]):
                self.expect("pipes, devices, folders", words, codes=(2,))
        for image in ("pipe.png", "zero.png"):
            if image == "pipe.png":
                os.mkfifo(self.folder / image)
            else:
                os.symlink("/dev/zero", self.folder / image)
            self.expect("pipes, devices, folders",
                        ["render", self.put_scene("fifo.gltf", [image]), "-o", "f"], codes=(2,))
        (self.folder / "jsonl").mkdir()
        os.mkfifo(self.folder / "jsonl/frames.jsonl")
        good = self.put_scene("good.gltf", [])
        self.expect("pipes, devices, folders",
                    ["render", good, "-o", "jsonl", "--resume", *self.RENDER], codes=(2,))
        for target in ("/dev/null", "pipe"):
            self.expect("outputs that are not files",
                        ["simulate", "storm", "-o", "x.csv", "--checkpoint", target], codes=(2,))
        self.write("victim", "precious")
        os.symlink("victim", self.folder / "link.csv")
        self.expect("outputs that are not files", ["simulate", "storm", "-o", "link.csv"], codes=(2,))
        good = (self.folder / "victim").read_text() == "precious"
        self.table.note("outputs that are not files", good, 0, 0.0, "a link's target was written")

    def links(self):
        (self.folder / "lay").mkdir()
        os.symlink("/etc/passwd", self.folder / "lay/wall.png")
        document, data = scene(["wall.png"])
        self.write("lay/floor.bin", data)
        self.write("lay/s.gltf", json.dumps(document))
        self.expect("links out of the scene", ["render", "lay/s.gltf", "-o", "l"], codes=(2,),
                    word="--allow-outside")
        self.expect("links out of the scene",
                    ["render", "lay/s.gltf", "-o", "l", "--allow-outside"], codes=(2,), word="none of PNG")

    def stdout(self):
        csv = self.write("k.csv", "time_s,temperature_c,rainfall\n0,5,0\n10,4,1\n")
        self.write("t.png", png(8, 8, 8, 2, b"\x80\x40\x20" * 8))
        for words in (["simulate", csv], ["doctor", "--json"], ["doctor"], ["simulate", "--list"],
                      ["texture", "inspect", "t.png", "--json"], ["render", "--list-aovs"],
                      ["texture", "compare", "t.png", "t.png", "--json"], ["--help"]):
            with open("/dev/full", "wb") as full:
                self.expect("a full standard output", words, codes=(2,), stdout=full)
            reader, writer = os.pipe()
            os.close(reader)
            run = self.expect("a closed pipe", words, codes=(141,), stdout=writer)
            os.close(writer)
            if b"error" in run.err:
                self.table.note("a closed pipe", False, 0, 0.0, "it was not quiet: " + run.what())

    def weather(self):
        self.write("years.csv", "time,air_temp_c\n1900-01-01T00:00,1\n2100-01-01T00:00,2\n")
        self.expect("weather of centuries", ["simulate", "years.csv", "-o", "y.csv"], codes=(2,), word="--max-gap")
        self.expect("weather of centuries", ["simulate", "years.csv", "-o", "y.csv", "--max-gap", "99999",
                     "--latitude", "50", "--longitude", "8"],
                    codes=(2,), word="--from")
        base = b"time,air_temp_c,wind_m_s,precip_mm\n" + b"".join(
            b"2020-01-01T%02d:00,%d,2,0.1\n" % (h, h) for h in range(24))
        for i in range(200 if self.all else 40):
            file = self.write(f"m{i}.csv", mutated(base, self.random))
            self.expect("damaged weather", ["simulate", file, "-o", "m.csv"])

    def images(self):
        sizes = [(16384, 16384, 8, 0, b"\x80" * 16384)]
        if self.all:
            sizes.append((8192, 8192, 16, 6, b"\x80" * (8192 * 8)))
        for i, size in enumerate(sizes):
            self.write(f"huge{i}.png", png(*size))
            file = self.put_scene(f"huge{i}.gltf", [f"huge{i}.png"])
            words = ["render", file, "-o", f"huge{i}", *self.RENDER]
            self.expect("huge images", words, codes=(0, 2))
        picture = png(64, 64, 8, 2, bytes(range(192)))
        for i in range(300 if self.all else 60):
            file = self.write(f"d{i}.png", mutated(picture, self.random))
            self.expect("damaged images", ["texture", "convert", file, "-o", "d.tga"])
        self.write("m.png", png(1024, 1024, 8, 2, b"\x80\x40\x20" * 1024))
        many = [f"m{i}.png" for i in range(60)]
        for name in many:
            os.link(self.folder / "m.png", self.folder / name)
        self.expect("a scene over its budget",
                    ["render", self.put_scene("many.gltf", many), "-o", "many", "--memory", "512"],
                    codes=(2,), word="max_texture")

    def scenes(self):
        document, data = scene([])
        self.write("floor.bin", data)
        text = json.dumps(document).encode()
        for i in range(300 if self.all else 60):
            file = self.write(f"g{i}.gltf", mutated(text, self.random))
            # An impossible camera stops the run before a device is looked for.
            self.expect("damaged scenes", ["render", file, "-o", "g", "--camera", "none"], codes=(2,))
        self.put_scene("esc.gltf", [], name="a\u001b[2Jb")
        self.expect("names in scenes", ["render", "esc.gltf", "-o", "g", "--camera", "\x1b[2J"], codes=(2,))

        # Twenty thousand primitives of one material and mesh are one draw.
        side, corners = 141, ((0, 0), (.28, 0), (.28, .28), (0, .28))
        places = [(i % side * .3 - 21, i // side * .3 - 21) for i in range(20000)]
        document, _ = scene([])
        data = b"".join(struct.pack("<3f", x + c[0], 0, z + c[1]) for x, z in places for c in corners)
        document["meshes"][0]["primitives"] = [{"attributes": {"POSITION": i}, "indices": len(places), "material": 0}
                                               for i in range(len(places))]
        document["bufferViews"] = [{"buffer": 0, "byteLength": len(data)},
                                   {"buffer": 0, "byteOffset": len(data), "byteLength": 12}]
        document["accessors"] = [{"bufferView": 0, "byteOffset": 48 * i, "componentType": 5126, "count": 4,
                                  "type": "VEC3", "min": [x, 0, z], "max": [x + .28, 0, z + .28]}
                                 for i, (x, z) in enumerate(places)]
        document["accessors"].append({"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"})
        document["buffers"] = [{"uri": "grid.bin", "byteLength": len(data) + 12}]
        self.write("grid.bin", data + struct.pack("<6H", 0, 2, 1, 0, 3, 2))
        file = self.write("grid.gltf", json.dumps(document))
        self.expect("many primitives", ["render", file, "-o", "grid", *self.RENDER], codes=(0,) if self.device else (2,))

    def interrupts(self):
        scene = self.put_scene("int.gltf", [])
        self.write("large.png", png(8192, 8192, 8, 2, b"\x80\x40\x20" * 8192))
        works = [["texture", "mips", "large.png", "-o", "int/m_%d.png"],
                 ["texture", "convert", "large.png", "-o", "int/large.tif"],
                 ["simulate", "storm", "-o", "int/a.csv", "--every", "0.0001"]]
        if self.device:
            works.insert(0, ["render", scene, "-o", "int", "--size", "320x180", "--count", "500", "--samples", "4"])
        for i in range(24 if self.all else 6):
            work, after = works[i % len(works)], self.random.uniform(0.02, 2.0)
            run = self.run(work, interrupt_s=after, sig=self.random.choice((signal.SIGINT, signal.SIGTERM)))
            left = self.leftovers("int")
            good = run.code in (0, 130) and run.late_s < 0.5 + run.machine_late_s and not left
            self.table.note("interrupts", good, run.mib, run.late_s,
                            f"{work[:2]} after {after:.2f} s, machine late {run.machine_late_s:.2f} s, {left}: "
                            f"{run.what()}")

    def kills(self):
        if not self.device:
            return
        good = self.put_scene("kill.gltf", [])
        words = ["render", good, "-o", "kill", "--size", "160x90", "--count", "6", "--samples", "1",
                 "--resume", "--no-film"]
        for i in range(12 if self.all else 3):
            self.run(words, kill_s=self.random.uniform(0.2, 1.5))
        run = self.run(words)
        names = sorted(p.name for p in (self.folder / "kill").iterdir())
        whole = run.code == 0 and not self.leftovers("kill") and len(names) == 13
        self.table.note("kills, then the rest", whole, run.mib, run.seconds, f"{names}: {run.what()}")
        alone = self.run([w if w != "kill" else "alone" for w in words])
        same = alone.code == 0 and all(
            (self.folder / "kill" / n).read_bytes() == (self.folder / "alone" / n).read_bytes() for n in names)
        self.table.note("kills, then the rest", same, alone.mib, alone.seconds, "other bytes than in one run")
        # Two writers of one folder at once: each a half, both everything, and one that is killed.
        for frames, killed in ((("0:2", "3:5"), None), (("0:5", "0:5"), None), (("0:5", "0:5"), 0.9)):
            shutil.rmtree(self.folder / "two", ignore_errors=True)
            writers = [subprocess.Popen([self.program, *[w if w != "kill" else "two" for w in words], "--frames", f],
                                        cwd=self.folder, stderr=subprocess.DEVNULL) for f in frames]
            if killed:
                time.sleep(killed)
                writers[0].kill()
            codes = [w.wait(timeout=120) for w in writers]
            there = sorted(p.name for p in (self.folder / "two").iterdir() if not p.name.startswith(".petrichor-"))
            both = codes[1] == 0 and (killed or codes[0] == 0) and there == names and all(
                (self.folder / "two" / n).read_bytes() == (self.folder / "alone" / n).read_bytes() for n in names)
            self.table.note("two writers", both, 0, 0.0, f"exit codes {codes}, {there}")

    def full_disk(self):
        for words, folder in ((["texture", "generate", "cobble", "--size", "64", "-o", "half"], "half"),
                              (["simulate", "storm", "-o", "disk/a.csv"], "disk")):
            for limit in (0, 1000, 5000):
                self.expect("a full disk", words, codes=(2,), file_limit=limit)
                left = [p.name for p in (self.folder / folder).rglob("*")] if (self.folder / folder).exists() else []
                self.table.note("a full disk", not left, 0, 0.0, f"left behind: {left}")
                shutil.rmtree(self.folder / folder, ignore_errors=True)
        self.small_disk()
        run = self.run(["texture", "generate", "cobble", "--size", "64", "-o", "half"])
        self.table.note("a full disk", run.code == 0, run.mib, run.seconds, run.what())

    def small_disk(self):
        """A file system of 300 KiB, where this user may mount one."""
        (self.folder / "mount").mkdir()
        inside = ["unshare", "-rm", "sh", "-c", "mount -t tmpfs -o size=300k tmpfs mount && exec \"$@\"", "sh"]
        probe = shutil.which("unshare") and subprocess.run([*inside, "true"], cwd=self.folder,
                                                            stderr=subprocess.DEVNULL).returncode == 0
        if not probe:
            print("no small disk: a file system cannot be mounted here; file limits are tried instead")
            return
        listing = "\"$@\"; code=$?; ls -A mount | sed s/^/left:/; exit $code"
        works = [["texture", "generate", "cobble", "--size", "512", "-o", "mount"]]
        if self.device:
            works.append(["render", self.put_scene("full.gltf", []), "-o", "mount", "--size", "320x180", "--count", "9",
                          "--samples", "1"])
        for work in works:
            run = Run("unshare", [*inside, "sh", "-c", listing, "sh", self.program, *work], self.folder)
            left = [line for line in run.out.decode().splitlines() if line.startswith("left:.")]
            good = run.answered((2,)) and not left and b"No space left" in run.err
            self.table.note("a small disk", good, run.mib, run.seconds, f"{work[:2]} {left}: {run.what()}")

    def resumes(self):
        """Pictures are made again when what they show changed, and only then."""
        if not self.device:
            return
        image = lambda color: png(16, 16, 8, 2, color * 16)
        self.write("wall.png", image(b"\x80\x40\x20"))
        words = ["render", self.put_scene("res.gltf", ["wall.png"]), "-o", "res", *self.RENDER, "--resume"]
        self.expect("resumes", words, codes=(0,), word="1 frames rendered")
        self.expect("resumes", words, codes=(0,), word="0 frames rendered")
        self.write("wall.png", image(b"\x20\x40\x80"))
        self.expect("resumes", words, codes=(0,), word="scene files changed")
        self.expect("resumes", [*words, "--verify"], codes=(0,), word="0 frames rendered")

    CLASSES = ("toml_depth", "names", "not_files", "links", "stdout", "weather", "images", "scenes",
               "interrupts", "kills", "full_disk", "resumes")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    folder = Path(tempfile.mkdtemp(prefix="petrichor-hostile-"))
    try:
        hostile = Hostile(options, folder)
        for name in Hostile.CLASSES:
            if options.only in name:
                start = time.monotonic()
                getattr(hostile, name)()
                print(f"{name}: {time.monotonic() - start:.1f} s", file=sys.stderr)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print(f"seed {options.seed}")
    hostile.table.print()
    return 1 if hostile.table.problems else 0


if __name__ == "__main__":
    sys.exit(main())
