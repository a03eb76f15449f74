#include "gpu/upload/material_constants.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "base/error.h"
#include "scene/material_table.h"

namespace petrichor::gpu {

static_assert(LAYER_TEXTURE_SLOTS == scene::kMostLayerTextures);

namespace {

using shared::MaterialConstants;

const scene::MaterialProperty& row_of(const MaterialField& field)
{
    const scene::MaterialProperty* row = scene::find_property(field.name);
    if (!row || field.size != 4u * static_cast<std::size_t>(row->count) ||
        field.whole != (row->kind != scene::PropertyKind::Number)) {
        throw Error("material constants: the field " + std::string(field.name) +
                        " has no row of its type in the material table",
                    "Report this: the program contradicts itself.");
    }
    return *row;
}

const scene::MaterialTexture& row_of(std::string_view texture)
{
    for (const scene::MaterialTexture& row : scene::material_textures()) {
        if (row.name == texture) return row;
    }
    throw Error("material constants: the slot " + std::string(texture) +
                    " has no row in the material table",
                "Report this: the program contradicts itself.");
}

shared::TextureSlot slot_constants(const TextureUse& use, const std::vector<bool>& loaded)
{
    // glTF: offset * rotation * scale, rotation counter-clockwise in a v-down frame.
    const float c = std::cos(use.rotation_rad);
    const float s = std::sin(use.rotation_rad);
    shared::TextureSlot slot{};
    slot.row0 = {c * use.scale.x, s * use.scale.y, use.offset.x};
    slot.row1 = {-s * use.scale.x, c * use.scale.y, use.offset.y};
    slot.channel[static_cast<int>(use.channel)] = 1.0f;
    slot.texcoord = use.texcoord == 1 ? 1u : 0u;
    const auto texture = static_cast<std::size_t>(use.texture);
    slot.present = use.present() && texture < loaded.size() && loaded[texture] ? 1u : 0u;
    return slot;
}

}  // namespace

const std::vector<MaterialField>& material_fields()
{
#define MATERIAL_FIELD(type, name)                                              \
    {#name, offsetof(MaterialConstants, name), sizeof(MaterialConstants::name), \
     std::is_same_v<decltype(MaterialConstants::name), std::uint32_t>},
    static const std::vector<MaterialField> fields{MATERIAL_FIELDS(MATERIAL_FIELD)};
#undef MATERIAL_FIELD
    return fields;
}

std::vector<const TextureUse*> slots_of(const Material& material)
{
    std::vector<const TextureUse*> slots(TEXTURE_SLOTS);
#define MATERIAL_SLOT(slot, name) slots[slot] = &row_of(#name).get(material);
    MATERIAL_TEXTURES(MATERIAL_SLOT)
#undef MATERIAL_SLOT
    return slots;
}

LayerSlots layer_slots_of(const Material& material, const std::vector<bool>& loaded)
{
    LayerSlots slots;
    const auto take = [&](std::uint32_t role, std::string_view name) {
        const TextureUse& use = row_of(name).get(material);
        const auto texture = static_cast<std::size_t>(use.texture);
        if (!use.present() || texture >= loaded.size() || !loaded[texture] ||
            slots.uses.size() == LAYER_TEXTURE_SLOTS) return;
        if (role == LAYER_TEXTURE_THROUGH && material.diffuse_transmission_of_base) return;
        slots.uses.push_back(&use);
        slots.roles[role / LAYER_ROLES_A_WORD] |= static_cast<std::uint32_t>(slots.uses.size())
                                                  << 4 * (role % LAYER_ROLES_A_WORD);
        slots.of_light = slots.of_light || role < LAYER_TEXTURES_OF_LIGHT || role == LAYER_TEXTURE_SECOND_LOBE ||
                         role == LAYER_TEXTURE_IRIDESCENCE || role == LAYER_TEXTURE_THROUGH;
    };
#define LAYER_ROLE(role, name) take(role, #name);
    LAYER_TEXTURES(LAYER_ROLE)
#undef LAYER_ROLE
    return slots;
}

MaterialConstants material_constants(const Material& material, const std::vector<bool>& loaded)
{
    MaterialConstants constants{};
    auto* bytes = reinterpret_cast<std::byte*>(&constants);
    for (const MaterialField& field : material_fields()) {
        const glm::vec4 value = row_of(field).get(material);
        if (field.whole) {
            const auto word = static_cast<std::uint32_t>(value.x);
            std::memcpy(bytes + field.offset, &word, sizeof(word));
        } else {
            std::memcpy(bytes + field.offset, &value, field.size);
        }
    }
    const auto slots = slots_of(material);
    for (std::size_t i = 0; i < slots.size(); ++i) {
        constants.slots[i] = slot_constants(*slots[i], loaded);
    }
    const LayerSlots layers = layer_slots_of(material, loaded);
    for (std::size_t i = 0; i < layers.uses.size(); ++i)
        constants.slots[TEXTURE_SLOTS + i] = slot_constants(*layers.uses[i], loaded);
    const auto tile = [&constants](int slot, const glm::vec2& tiling) {
        constants.slots[slot].row0 *= tiling.x;
        constants.slots[slot].row1 *= tiling.y;
    };
    const scene::SecondSet& second = material.second;
    tile(TEXTURE_MIX_MASK, second.mix_mask_tiling);
    for (const int slot : {TEXTURE_SECOND_BASE_COLOR, TEXTURE_SECOND_NORMAL,
                           TEXTURE_SECOND_METALLIC_ROUGHNESS, TEXTURE_SECOND_HEIGHT}) {
        tile(slot, second.tiling);
    }
    for (std::size_t i = 0; i < layers.uses.size(); ++i) {
        const int slot = TEXTURE_SLOTS + static_cast<int>(i);
        for (const scene::GroundLayer* layer : {&second.third, &second.fourth}) {
            if (layers.uses[i] == &layer->base_color_texture || layers.uses[i] == &layer->normal_texture ||
                layers.uses[i] == &layer->metallic_roughness_texture)
                tile(slot, layer->tiling);
        }
    }
    if (!second.own_water) {
        constants.second_water_accumulation = constants.water_accumulation;
        constants.second_water_color = constants.water_color;
    }
    return constants;
}

bool is_blended(const Material& material)
{
    return material.alpha_mode == AlphaMode::Blend || material.transmission > 0.0f;
}

}  // namespace petrichor::gpu
