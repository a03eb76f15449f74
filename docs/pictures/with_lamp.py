"""A model with a lamp beside it: a point light of KHR_lights_punctual, warm white.

    with_lamp.py IN.glb OUT.glb X_M Y_M Z_M CANDELA
"""
import json
import struct
import sys

if len(sys.argv) != 7:
    sys.exit(__doc__)
source, target = sys.argv[1:3]
x, y, z, candela = (float(word) for word in sys.argv[3:7])
with open(source, "rb") as file:
    data = file.read()
length = struct.unpack_from("<I", data, 12)[0]
scene = json.loads(data[20:20 + length])
rest = data[20 + length:]  # the binary chunk

extension = scene.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})
extension["lights"].append({"type": "point", "name": "lamp", "color": [1.0, 0.75, 0.5], "intensity": candela})
used = scene.setdefault("extensionsUsed", [])
if "KHR_lights_punctual" not in used:
    used.append("KHR_lights_punctual")
scene["nodes"].append({"name": "lamp", "translation": [x, y, z],
                       "extensions": {"KHR_lights_punctual": {"light": len(extension["lights"]) - 1}}})
scene["scenes"][scene.get("scene", 0)]["nodes"].append(len(scene["nodes"]) - 1)

text = json.dumps(scene, separators=(",", ":")).encode()
text += b" " * (-len(text) % 4)
with open(target, "wb") as file:
    file.write(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text + rest)
