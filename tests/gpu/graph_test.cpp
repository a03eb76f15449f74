// The graph on a device, with synchronization validation: what bindings and attachments declare is
// enough, and a declaration that lies is caught.
#include "gpu/device/graph.h"
#include "formulas/light/cube_quads.h"
#include "gpu/frame/pixel_list.h"
#include "gpu/frame/pixel_list_io.h"
#include "gpu/passes/glare/glare.h"
#include "gpu/passes/sky/scattered_again.h"
#include "gpu/passes/sky/sky_io.h"
#include "gpu/passes/surface_maps/surface_maps.h"

#include <array>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "tests/gpu/gpu_fixture.h"

namespace petrichor::gpu {
namespace {

constexpr VkDeviceSize kProbes = 64;  // one workgroup of the probe

class GraphTest : public GpuTest {
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        if (!renderer) return;
        renderer.reset();  // its device is not needed
        device = std::make_unique<Device>(RendererOptions{.device = "", .validation = true});
        pipelines = std::make_unique<PipelineCache>(*device);
        descriptors = std::make_unique<DescriptorArena>(*device);
        arena = std::make_unique<MemoryArena>(*device);
        nearest = make_sampler(*device, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                               VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    }

    // Read through texels, written as storage, mapped.
    std::unique_ptr<GpuBuffer> numbers(const std::string& name)
    {
        auto made = arena->buffer({.name = name,
                                   .size = 3 * kProbes * sizeof(glm::vec4),
                                   .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                            VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                            VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                            VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                   .texel_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                   .host = true});
        std::fill(made->mapped, made->mapped + made->size, std::byte{0});
        return made;
    }

    // A dispatch that reads `from` and writes `to`.
    ComputePass probe(const Binding& from, const Binding& to)
    {
        return {.name = "probe",
                .shader = "formula_probe.comp",
                .constants = {},
                .bindings = {{0, from}, {1, to}},
                .push = PushBlock(0),
                .groups = {}};
    }

    // A small one: word 0 of `to` is a 64th of that of `from`, rounded up, the next two are 1. Each constant has a pipeline
    // of its own.
    static ComputePass sixty_fourth(GpuBuffer& from, GpuBuffer& to, std::uint32_t constant)
    {
        return {.name = "lists",
                .shader = "list_groups.comp",
                .constants = {{7, constant}},
                .bindings = {{LIST_GROUPS_LIST, storage_buffer(from)}, {LIST_GROUPS_GROUPS, storage_buffer(to)}},
                .push = {},
                .groups = {}};
    }

    void expect_silence() const
    {
        for (const std::string& message : device->validation_messages()) ADD_FAILURE() << message;
    }
    bool hazard_reported() const
    {
        for (const std::string& message : device->validation_messages()) {
            if (message.find("SYNC-HAZARD") != std::string::npos) return true;
        }
        return false;
    }

    std::unique_ptr<Device> device;
    std::unique_ptr<PipelineCache> pipelines;
    std::unique_ptr<DescriptorArena> descriptors;
    std::unique_ptr<MemoryArena> arena;
    SamplerHandle nearest;
};

TEST_F(GraphTest, EveryHazardBetweenBuffersIsCovered)
{
    const auto a = numbers("a");
    const auto b = numbers("b");
    const auto c = numbers("c");
    FrameGraph graph;
    graph.add(probe(texels(*a), storage_buffer(*b)));  // first write
    graph.add(probe(texels(*b), storage_buffer(*c)));  // read after write
    graph.add(probe(texels(*a), storage_buffer(*b)));  // write after read
    graph.add(probe(texels(*a), storage_buffer(*b)));  // write after write
    graph.add(probe(texels(*b), storage_buffer(*a)));  // write after a first read
    graph.read_back({b.get()});                        // a second kind of read
    graph.add(TransferPass{
        "copy",  // a third kind
        {{nullptr, b.get(), Use::TransferSource}, {nullptr, c.get(), Use::TransferTarget}},
        [&](VkCommandBuffer commands) {
            const VkBufferCopy region{0, 0, kProbes};
            vkCmdCopyBuffer(commands, b->buffer.get(), c->buffer.get(), 1, &region);
        }});
    graph.execute(*device, *pipelines, *descriptors);
    graph.execute(*device, *pipelines, *descriptors);  // states go on from frame to frame
    expect_silence();
}

// Each texel of a cube is another number; each quad holds the four around it, over the edges of faces too.
TEST_F(GraphTest, QuadsOfACubeHoldWhatLiesAroundThem)
{
    constexpr int side = 8;
    constexpr int quads = 6 * (side + 1) * (side + 1);
    const auto number = [](int face, glm::ivec2 texel) { return static_cast<float>((face * side + texel.y) * side + texel.x); };
    std::vector<std::byte> texels_of_it;
    for (int i = 0; i < 6 * side * side; ++i) {
        const std::uint64_t texel = glm::packHalf4x16(glm::vec4(static_cast<float>(i), 0.0f, 1.0f, 1.0f));
        const auto* bytes = reinterpret_cast<const std::byte*>(&texel);
        texels_of_it.insert(texels_of_it.end(), bytes, bytes + sizeof texel);
    }
    const auto cube = arena->image({.name = "cube",
                                    .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                    .width = side,
                                    .height = side,
                                    .layers = 6,
                                    .cube = true,
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                             VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    upload_image(*device, *cube, {texels_of_it});
    const int begin = shared::cube_quads_begin(3);
    const auto made = arena->buffer({.name = "quads",
                                     .size = static_cast<VkDeviceSize>(begin + quads) * sizeof(glm::uvec4),
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                     .host = true});
    FrameGraph graph;
    graph.add(ComputePass{.name = "sky_quads",
                          .shader = "sky_quads.comp",
                          .constants = {},
                          .bindings = {{SKY_SOURCE, storage(*cube, 0)}, {SKY_TARGET, storage_buffer(*made)}},
                          .push = PushBlock(shared::SkyQuadsParams{begin}),
                          .groups = groups_over(side + 1, side + 1, SKY_TILE, 6)});
    graph.read_back({made.get()});
    graph.execute(*device, *pipelines, *descriptors);
    const auto* words = reinterpret_cast<const glm::uvec4*>(made->mapped);
    int corners = 0;
    for (int k = 0; k < quads; ++k) {
        const int face = k / ((side + 1) * (side + 1));
        const glm::ivec2 quad(k % (side + 1), k / (side + 1) % (side + 1));
        float sum = 0.0f, mean = -1.0f;
        for (int i = 0; i < 4; ++i) {
            const glm::ivec2 texel = quad - 1 + glm::ivec2(i & 1, i >> 1);
            const glm::bvec2 inside = glm::equal(glm::clamp(texel, 0, side - 1), texel);
            const float held = shared::light_of_word(words[begin + k][i], 1.0f).x;
            if (!inside.x && !inside.y) {
                mean = held;
                continue;
            }
            float expected = number(face, texel);
            if (!glm::all(inside)) {
                const shared::CubePlace beside = shared::cube_beside(face, texel, side);
                expected = number(beside.face, glm::ivec2((beside.st * 0.5f + 0.5f) * static_cast<float>(side)));
            }
            ASSERT_EQ(held, expected) << "face " << face << " quad " << quad.x << " " << quad.y << " texel " << i;
            sum += expected;
        }
        if (mean < 0.0f) continue;
        EXPECT_NEAR(mean, sum / 3.0f, 0.51f);
        ++corners;
    }
    EXPECT_EQ(corners, 24);
    expect_silence();
}

// Codes of 8 bits that are halved six times: blits of some drivers lose half a code at each level.
TEST_F(GraphTest, LevelsOfAWeatherMapKeepItsMean)
{
    constexpr int side = 64;
    WeatherMaps given;
    given.snow.size = side;
    std::uint32_t state = 1;
    glm::dvec4 mean(0.0);
    for (int i = 0; i < side * side * 4; ++i) {
        state = state * 1664525u + 1013904223u;
        const std::uint32_t code = 40u + (state >> 24) % 100u;
        given.snow.rgba.push_back(static_cast<std::byte>(code));
        mean[i % 4] += static_cast<double>(code) / (side * side);
    }
    SurfaceMaps maps(*device, *arena, 16, given);
    const auto levels = arena->buffer(
        {.name = "levels", .size = side * side * 8, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT, .host = true});
    const auto begin = [](int level) {
        int first = 0;
        for (int i = 0; i < level; ++i) first += 4 * (side >> i) * (side >> i);
        return first;
    };
    FrameGraph graph;
    add_surface_map_sources(graph, maps);
    graph.add(TransferPass{
        "levels",
        {{maps.snow.get(), nullptr, Use::TransferSource}, {nullptr, levels.get(), Use::TransferTarget}},
        [&](VkCommandBuffer commands) {
            for (int level = 0; level < maps.snow->mips; ++level) {
                const auto wide = static_cast<std::uint32_t>(side >> level);
                VkBufferImageCopy region{};
                region.bufferOffset = static_cast<VkDeviceSize>(begin(level));
                region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, static_cast<std::uint32_t>(level), 0, 1};
                region.imageExtent = {wide, wide, 1};
                vkCmdCopyImageToBuffer(commands, maps.snow->image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                       levels->buffer.get(), 1, &region);
            }
        }});
    graph.read_back({levels.get()});
    graph.execute(*device, *pipelines, *descriptors);
    ASSERT_EQ(maps.snow->mips, 7);
    for (int level = 0; level < maps.snow->mips; ++level) {
        const int count = (side >> level) * (side >> level);
        glm::dvec4 of_level(0.0);
        for (int i = 0; i < 4 * count; ++i)
            of_level[i % 4] += static_cast<double>(levels->mapped[begin(level) + i]) / count;
        // One texel is rounded by itself; many keep the mean.
        const double bound = 0.08 + 0.8 / std::sqrt(count);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(of_level[c], mean[c], bound) << "level " << level << " channel " << c;
    }
    expect_silence();
}

TEST_F(GraphTest, LayoutsFollowWhatImagesAreUsedFor)
{
    const auto image =
        arena->image({.name = "image",
                      .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                      .width = 64,
                      .height = 96,
                      .mips = 3,
                      .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                               VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    const auto cube =
        arena->image({.name = "cube",
                      .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                      .width = 8,
                      .height = 8,
                      .layers = 6,
                      .cube = true,
                      .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT});
    const auto level =
        arena->image({.name = "level",
                      .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                      .width = 16,
                      .height = 16,
                      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    const auto table = arena->buffer({.name = "table", .size = sizeof(ScatteredAgain::Table)});
    FrameGraph graph;
    for (int i = 0; i < 2; ++i) {
        graph.add(ComputePass{"write", "sky_air.comp", {}, {{0, storage(*image, 0)}, {1, storage_buffer(*table)}}, {}, {8, 12}});
        graph.add(TransferPass{"mips",
                               {{image.get(), nullptr, Use::TransferTarget}},
                               [&](VkCommandBuffer commands) { record_mips(commands, *image); }});
        graph.add(ComputePass{"sample",
                              "sky_cube.comp",
                              {},
                              {{0, sampled(*image, nearest)}, {1, storage(*cube, 0)}},
                              {},
                              {1, 1, 6}});
        graph.add(DrawPass{.name = "clear",
                           .colors = {Attachment(*level), Attachment()},
                           .depth = {},
                           .width = 16,
                           .height = 16,
                           .bindings = {{0, sampled(*image, nearest)}},
                           .record = [](PassContext& pass) {
                               EXPECT_EQ(pass.color_formats()[1], VK_FORMAT_UNDEFINED);
                           }});
    }
    graph.execute(*device, *pipelines, *descriptors);
    EXPECT_EQ(image->state.layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_EQ(level->state.layout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    expect_silence();
}

// Glare is the same whether the device looks between texels or the shader weighs them, at sides of odd length and borders too.
TEST_F(GraphTest, GlareIsTheSameWithAndWithoutFilters)
{
    if (!device->filters_floats()) GTEST_SKIP() << "no filter of floats";
    constexpr int kWidth = 37, kHeight = 23;
    const auto picture = [&](int width, int height, VkImageUsageFlags usage) {
        return arena->image({.name = "picture",
                             .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                             .width = width,
                             .height = height,
                             .usage = usage | VK_IMAGE_USAGE_SAMPLED_BIT});
    };
    std::vector<float> light(kWidth * kHeight * 4);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = (i * 7919) % 101 == 0 ? 900.0f : static_cast<float>((i * 31) % 17);
    std::vector<std::byte> bytes(light.size() * sizeof(float));
    std::memcpy(bytes.data(), light.data(), bytes.size());
    const auto glare = [&](bool filters) {
        FrameTargets targets;
        targets.width = kWidth;
        targets.height = kHeight;
        targets.accumulated = picture(kWidth, kHeight, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
        for (int w = kWidth, h = kHeight; targets.glare.size() < 4;) {
            w = (w + 1) / 2;
            h = (h + 1) / 2;
            targets.glare.push_back(picture(w, h, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
        }
        targets.filters = filters;
        targets.between = make_sampler(*device, filters ? VK_FILTER_LINEAR : VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                       VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false, 0.0f, true);
        upload_image(*device, *targets.accumulated, {bytes});
        GpuImage& first = *targets.glare.front();
        const auto read = arena->buffer({.name = "read",
                                         .size = static_cast<VkDeviceSize>(first.width * first.height) * 16,
                                         .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                         .host = true});
        FrameGraph graph;
        add_glare(graph, targets, 1);
        graph.add(TransferPass{.name = "read",
                               .transfers = {{&first, nullptr, Use::TransferSource}, {nullptr, read.get(), Use::TransferTarget}},
                               .record = [&](VkCommandBuffer commands) {
                                   VkBufferImageCopy region{};
                                   region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
                                   region.imageExtent = {static_cast<std::uint32_t>(first.width), static_cast<std::uint32_t>(first.height), 1};
                                   vkCmdCopyImageToBuffer(commands, first.image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                                          read->buffer.get(), 1, &region);
                               }});
        graph.read_back({read.get()});
        graph.execute(*device, *pipelines, *descriptors);
        descriptors->reset();
        std::vector<float> values(read->size / sizeof(float));
        std::memcpy(values.data(), read->mapped, read->size);
        return values;
    };
    const std::vector<float> weighed = glare(false), filtered = glare(true);
    ASSERT_EQ(weighed.size(), filtered.size());
    // Devices place a sample to 1/256 of a texel; between texels this far apart the rest is rounding.
    for (std::size_t i = 0; i < weighed.size(); ++i) EXPECT_NEAR(filtered[i], weighed[i], 2.0e-4f * weighed[i] + 2.0e-3f) << i;
    expect_silence();
}

// Widths whose rows lie without gaps on a CPU, and one that leaves some: what is written to the image is in the
// buffer either way, again after a second write.
TEST_F(GraphTest, RowsHoldWhatWasWrittenToTheirImage)
{
    for (const int width : {16, 48, 5}) {
        constexpr int kHeight = 7;
        const ImageInRows both = arena->image_in_rows(
            {.name = "picture",
             .format = VK_FORMAT_R32G32_UINT,
             .width = width,
             .height = kHeight,
             .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT},
            8);
        ASSERT_EQ(both.rows->size, static_cast<VkDeviceSize>(width * kHeight * 8));
        if (device->info().kind == "cpu") {
            EXPECT_EQ(both.rows->shows, width == 5 ? nullptr : both.image.get()) << width;
        }
        const auto from = arena->buffer({.name = "from",
                                         .size = both.rows->size,
                                         .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                         .host = true});
        const auto to = arena->buffer({.name = "to",
                                       .size = both.rows->size,
                                       .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                       .host = true});
        for (const std::uint32_t seed : {1u, 77u}) {
            std::vector<std::uint32_t> words(both.rows->size / 4);
            for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint32_t>(i) * 2654435761u + seed;
            std::memcpy(from->mapped, words.data(), both.rows->size);
            FrameGraph graph;
            graph.add(TransferPass{.name = "write",
                                   .transfers = {{both.image.get(), nullptr, Use::TransferTarget},
                                                 {nullptr, from.get(), Use::TransferSource}},
                                   .record = [&](VkCommandBuffer commands) {
                                       VkBufferImageCopy region{};
                                       region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
                                       region.imageExtent = {static_cast<std::uint32_t>(width), kHeight, 1};
                                       vkCmdCopyBufferToImage(commands, from->buffer.get(), both.image->image.get(),
                                                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
                                   }});
            add_rows(graph, "rows", {{both.image.get(), both.rows.get()}});
            graph.add(TransferPass{.name = "read",
                                   .transfers = {{nullptr, both.rows.get(), Use::TransferSource},
                                                 {nullptr, to.get(), Use::TransferTarget}},
                                   .record = [&](VkCommandBuffer commands) {
                                       const VkBufferCopy region{0, 0, both.rows->size};
                                       vkCmdCopyBuffer(commands, both.rows->buffer.get(), to->buffer.get(), 1, &region);
                                   }});
            graph.read_back({to.get()});
            graph.execute(*device, *pipelines, *descriptors);
            EXPECT_EQ(std::memcmp(to->mapped, words.data(), both.rows->size), 0) << width;
        }
    }
    expect_silence();
}

// The check itself works: a storage write declared as a read leaves the next reader without its
// barrier, and validation says so. Without this, silence above would prove nothing.
TEST_F(GraphTest, ABindingThatLiesAboutItsUseIsCaught)
{
    const auto a = numbers("a");
    const auto b = numbers("b");
    const auto c = numbers("c");
    Binding lie = storage_buffer(*b);
    lie.use = Use::StorageRead;
    FrameGraph graph;
    graph.add(probe(texels(*a), lie));
    graph.add(probe(texels(*b), storage_buffer(*c)));
    graph.execute(*device, *pipelines, *descriptors);
    EXPECT_TRUE(hazard_reported());
}

TEST_F(GraphTest, APassCannotReadWhatItWrites)
{
    const auto a = numbers("a");
    FrameGraph graph;
    EXPECT_THROW(graph.add(probe(texels(*a), storage_buffer(*a))), std::logic_error);
}

TEST_F(GraphTest, BindingsAreGivenOnceAndWithoutGaps)
{
    const auto a = numbers("a");
    const Binding binding = texels(*a);
    EXPECT_THROW(types_of(Bindings{{0, binding}, {0, binding}}), std::logic_error);
    EXPECT_THROW(types_of(Bindings{{0, binding}, {2, binding}}), std::logic_error);
    const BindingTypes types = types_of(Bindings{{1, binding}, {0, storage_buffer(*a)}});
    EXPECT_EQ(types[0], VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    EXPECT_EQ(types[1], VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
}

TEST_F(GraphTest, DescriptionAndTimesGoByName)
{
    const auto a = numbers("a");
    const auto b = numbers("b");
    FrameGraph graph;
    graph.add(probe(texels(*a), storage_buffer(*b)));
    graph.add(probe(texels(*a), storage_buffer(*b)));
    graph.read_back({b.get()});
    EXPECT_EQ(graph.describe(), "probe: reads a; writes b\nread_back: reads b; writes nothing\n");
    const auto times = graph.execute(*device, *pipelines, *descriptors);
    ASSERT_EQ(times.size(), 2u);
    EXPECT_EQ(times[0].name, "probe");
    EXPECT_GE(times[0].milliseconds, 0.0);
}

// Pipelines are made once for equal content, and told apart by their constants.
TEST_F(GraphTest, PipelinesAreKeptByContent)
{
    const auto a = numbers("a");
    const BindingTypes types = types_of(Bindings{{0, texels(*a)}, {1, storage_buffer(*a)}});
    const Pipeline& one = pipelines->compute("formula_probe.comp", {}, {types});
    EXPECT_EQ(&one, &pipelines->compute("formula_probe.comp", {}, {types}));
    EXPECT_NE(&one, &pipelines->compute("formula_probe.comp", {{7, 1}}, {types}));
    EXPECT_THROW(pipelines->compute("no_such_shader.comp", {}, {types}), std::logic_error);
}

TEST_F(GraphTest, PipelinesThatNoPictureAsksForAreGivenUp)
{
    const auto from = numbers("from");
    const auto to = numbers("to");
    const ComputePass pass = probe(texels(*from), storage_buffer(*to));
    const auto draw = [&](bool with_lists) {
        FrameGraph graph;
        graph.add(pass);
        if (with_lists) add_list_groups(graph, "lists", *from, *to);
        graph.execute(*device, *pipelines, *descriptors);
        descriptors->reset();
        pipelines->end_picture(2);
    };
    draw(true);
    EXPECT_EQ(pipelines->size(), 2u);
    draw(false);
    EXPECT_EQ(pipelines->size(), 2u);
    draw(false);
    EXPECT_EQ(pipelines->size(), 1u);
    draw(true);  // made again
    EXPECT_EQ(pipelines->size(), 2u);
    for (int i = 0; i < 5; ++i) draw(true);
    EXPECT_EQ(pipelines->size(), 2u);
    expect_silence();
}

// What is asked for no more goes before what is new comes; what the next graph has said it will ask for stays.
TEST_F(GraphTest, PipelinesThatNobodyWantsAreGivenUpAtOnce)
{
    const auto from = numbers("from");
    const auto to = numbers("to");
    const auto graph_of = [&](std::uint32_t constant) {
        FrameGraph graph;
        graph.add(sixty_fourth(*from, *to, constant));
        return graph;
    };
    for (const std::uint32_t constant : {1u, 2u, 3u}) {
        FrameGraph graph = graph_of(constant);
        graph.execute(*device, *pipelines, *descriptors);
        pipelines->end_picture(8);
    }
    EXPECT_EQ(pipelines->size(), 3u);
    FrameGraph sky = graph_of(1);  // of the picture at work
    sky.execute(*device, *pipelines, *descriptors);
    FrameGraph next = graph_of(3);
    pipelines->keep_only(next.pipelines());
    EXPECT_EQ(pipelines->size(), 2u);
    next.execute(*device, *pipelines, *descriptors);
    EXPECT_EQ(pipelines->size(), 2u) << "made again";
    expect_silence();
}

// Where many pipelines are new each pass is submitted by itself. It runs behind the one before all the same, and its
// time counts.
TEST_F(GraphTest, ManyNewPipelinesDoAsFewDo)
{
    constexpr std::uint32_t kPasses = static_cast<std::uint32_t>(PipelineCache::kMany) + 2;
    std::vector<std::unique_ptr<GpuBuffer>> chain;
    FrameGraph graph;
    for (std::uint32_t i = 0; i <= kPasses; ++i) chain.push_back(numbers("link" + std::to_string(i)));
    const std::uint32_t all = 0x80000000u;
    std::memcpy(chain[0]->mapped, &all, sizeof(all));
    for (std::uint32_t i = 0; i < kPasses; ++i) {
        ComputePass pass = sixty_fourth(*chain[i], *chain[i + 1], i);
        pass.name += std::to_string(i);
        graph.add(pass);
    }
    graph.read_back({chain.back().get()});
    const auto expect_ones = [&] {
        std::array<std::uint32_t, 3> last{};
        std::memcpy(last.data(), chain.back()->mapped, sizeof(last));
        EXPECT_EQ(last, (std::array<std::uint32_t, 3>{1, 1, 1}));
    };
    const auto first = graph.execute(*device, *pipelines, *descriptors);
    expect_ones();
    EXPECT_EQ(pipelines->size(), kPasses);
    for (std::size_t i = 1; i < chain.size(); ++i) std::fill_n(chain[i]->mapped, chain[i]->size, std::byte{0});
    const auto again = graph.execute(*device, *pipelines, *descriptors);
    expect_ones();
    ASSERT_EQ(first.size(), again.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].name, again[i].name);
        EXPECT_EQ(first[i].cpu_milliseconds, 0.0) << "only where passes are asked to run apart";
    }
    expect_silence();
}

}  // namespace
}  // namespace petrichor::gpu
