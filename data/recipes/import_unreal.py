"""Imports what `petrichor texture build --engine unreal` wrote into Unreal, with its mip levels.

In the editor's console (Python Editor Script Plugin):
    py "C:/out/import_unreal.py" /Game/Textures
Without a folder it imports to /Game/Petrichor. Reads manifest.json beside it.
"""
import json
import os
import sys

import unreal

COMPRESSION = {
    "color": unreal.TextureCompressionSettings.TC_DEFAULT,
    "normal": unreal.TextureCompressionSettings.TC_NORMALMAP,
    "grey": unreal.TextureCompressionSettings.TC_GRAYSCALE,
    "mask": unreal.TextureCompressionSettings.TC_MASKS,
}


def textures(folder):
    """(path below the folder, its entry of the manifest) of every texture for Unreal."""
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        manifest = json.load(file)
    for material in manifest["sets"]:
        for output in material["outputs"] if "unreal" in material["engines"] else []:
            for file in output["files"]:
                if os.path.basename(file["file"]).startswith("T_"):
                    yield file["file"], output


def import_texture(folder, name, output, destination):
    task = unreal.AssetImportTask()
    task.set_editor_property("filename", os.path.join(folder, name))
    place = os.path.dirname(name).replace("\\", "/")
    task.set_editor_property("destination_path", "/".join(filter(None, [destination, place])))
    task.set_editor_property("automated", True)
    task.set_editor_property("replace_existing", True)
    task.set_editor_property("save", False)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    for path in task.get_editor_property("imported_object_paths"):
        texture = unreal.load_asset(path)
        texture.set_editor_property("srgb", output["srgb"])
        texture.set_editor_property("compression_settings", COMPRESSION[output["use"]])
        texture.set_editor_property("flip_green_channel", False)
        if output["levels"] > 1:
            texture.set_editor_property(
                "mip_gen_settings", unreal.TextureMipGenSettings.TMGS_LEAVE_EXISTING_MIPS)
        unreal.EditorAssetLibrary.save_loaded_asset(texture)
        return True
    unreal.log_error("petrichor: Unreal did not import " + name)
    return False


def main(arguments):
    folder = os.path.dirname(os.path.abspath(__file__))
    destination = (arguments[0] if arguments else "/Game/Petrichor").rstrip("/")
    done = [import_texture(folder, name, output, destination) for name, output in textures(folder)]
    unreal.log("petrichor: %d of %d textures imported" % (sum(done), len(done)))


main(sys.argv[1:])
