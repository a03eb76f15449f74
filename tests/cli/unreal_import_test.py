"""Runs import_unreal.py of a build against a stand-in for Unreal's Python module.

unreal_import_test.py PETRICHOR: builds a wall, imports it, and looks at what Unreal was told.
"""
import pathlib
import struct
import subprocess
import sys
import tempfile
import types
import zlib


def png(size, color):
    row = b"\0" + bytes(color) * size
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)),
              (b"IDAT", zlib.compress(row * size)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks)


class Properties:
    def __init__(self):
        self.values = {}

    def set_editor_property(self, name, value):
        self.values[name] = value

    def get_editor_property(self, name):
        return self.values[name]


class Names:
    """An enumeration: every name is its own value."""

    def __getattr__(self, name):
        return name


def stand_in():
    assets = {}

    class Tools:
        @staticmethod
        def import_asset_tasks(tasks):
            for task in tasks:
                file = pathlib.Path(task.values["filename"])
                assert file.is_file(), file
                path = task.values["destination_path"] + "/" + file.stem
                assets[path] = Properties()
                task.values["imported_object_paths"] = [path]

    unreal = types.ModuleType("unreal")
    unreal.AssetImportTask = Properties
    unreal.TextureCompressionSettings = Names()
    unreal.TextureMipGenSettings = Names()
    unreal.AssetToolsHelpers = types.SimpleNamespace(get_asset_tools=lambda: Tools)
    unreal.load_asset = assets.__getitem__
    unreal.EditorAssetLibrary = types.SimpleNamespace(save_loaded_asset=lambda texture: True)
    unreal.log = unreal.log_error = print
    return unreal, assets


def main():
    petrichor = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "in").mkdir()
        for kind, color in (("albedo", (200, 90, 40)), ("normal_gl", (128, 128, 255)),
                            ("roughness", (90, 90, 90))):
            (folder / "in" / ("Wall_%s.png" % kind)).write_bytes(png(16, color))
        subprocess.run([petrichor, "texture", "build", "in", "--engine", "unreal", "--no-score",
                        "-o", "out"], cwd=folder, check=True)
        script = folder / "out" / "import_unreal.py"
        unreal, assets = stand_in()
        sys.modules["unreal"] = unreal
        sys.argv = [str(script), "/Game/Walls"]
        exec(compile(script.read_text(), str(script), "exec"), {"__file__": str(script)})

    expected = {"T_Wall_BC": (True, "TC_DEFAULT"), "T_Wall_N": (False, "TC_NORMALMAP"),
                "T_Wall_ORM": (False, "TC_MASKS")}
    assert set(assets) == {"/Game/Walls/" + name for name in expected}, sorted(assets)
    for name, (srgb, compression) in expected.items():
        told = assets["/Game/Walls/" + name].values
        assert told["srgb"] == srgb, (name, told)
        assert told["compression_settings"] == compression, (name, told)
        assert told["mip_gen_settings"] == "TMGS_LEAVE_EXISTING_MIPS", (name, told)


main()
