// Which dependency each pair of uses needs: pure, without a device.
#include "gpu/device/barriers.h"

#include <gtest/gtest.h>

namespace petrichor::gpu {
namespace {

constexpr bool kImage = true;
constexpr bool kBuffer = false;

ResourceState after(std::initializer_list<Use> uses, bool is_image)
{
    ResourceState state;
    for (const Use use : uses) advance(state, use, is_image);
    return state;
}

TEST(Barriers, TheFirstUseOfABufferWaitsForNothing)
{
    for (const Use use : {Use::TexelRead, Use::StorageWrite, Use::UniformRead, Use::HostRead}) {
        ResourceState state;
        EXPECT_FALSE(advance(state, use, kBuffer)) << static_cast<int>(use);
    }
}

TEST(Barriers, TheFirstUseOfAnImageMovesItToItsLayout)
{
    ResourceState state;
    const auto d = advance(state, Use::Sampled, kImage);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->from_layout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(d->to_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_EQ(state.layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

TEST(Barriers, AReadWaitsForTheWriteBefore)
{
    ResourceState state = after({Use::StorageWrite}, kBuffer);
    const auto d = advance(state, Use::TexelRead, kBuffer);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->from_stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
    EXPECT_EQ(d->from_access, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    EXPECT_EQ(d->to_access, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
}

TEST(Barriers, ASecondReadOfTheSameKindWaitsForNothing)
{
    ResourceState state = after({Use::StorageWrite, Use::TexelRead}, kBuffer);
    EXPECT_FALSE(advance(state, Use::TexelRead, kBuffer));
}

// The first reader must not clear the write for all others.
TEST(Barriers, ASecondKindOfReadWaitsForTheWriteToo)
{
    for (const Use second : {Use::UniformRead, Use::HostRead, Use::StorageRead}) {
        ResourceState state = after({Use::StorageWrite, Use::TexelRead}, kBuffer);
        const auto d = advance(state, second, kBuffer);
        ASSERT_TRUE(d) << static_cast<int>(second);
        EXPECT_EQ(d->from_stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
        EXPECT_EQ(d->from_access, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        EXPECT_EQ(d->to_stages, needs_of(second).stages);
        EXPECT_EQ(d->to_access, needs_of(second).access);
        EXPECT_FALSE(advance(state, second, kBuffer)) << "once is enough";
        EXPECT_FALSE(advance(state, Use::TexelRead, kBuffer)) << "the first kind still sees it";
    }
}

TEST(Barriers, AWriteWaitsForAllReaders)
{
    ResourceState state = after({Use::StorageWrite, Use::TexelRead, Use::HostRead}, kBuffer);
    const auto d = advance(state, Use::StorageWrite, kBuffer);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->from_stages & needs_of(Use::TexelRead).stages, needs_of(Use::TexelRead).stages);
    EXPECT_EQ(d->from_stages & VK_PIPELINE_STAGE_2_HOST_BIT, VK_PIPELINE_STAGE_2_HOST_BIT);
    EXPECT_TRUE(advance(state, Use::TexelRead, kBuffer)) << "and readers wait again";
}

TEST(Barriers, AWriteWaitsForReadersOfWhatWasNeverWritten)
{
    ResourceState state = after({Use::UniformRead}, kBuffer);
    const auto d = advance(state, Use::StorageWrite, kBuffer);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->from_stages, needs_of(Use::UniformRead).stages);
    EXPECT_EQ(d->from_access, VK_ACCESS_2_NONE);
}

TEST(Barriers, AWriteWaitsForTheWriteBefore)
{
    ResourceState state = after({Use::StorageWrite}, kBuffer);
    const auto d = advance(state, Use::StorageWrite, kBuffer);
    ASSERT_TRUE(d);
    EXPECT_EQ(d->from_access, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

// A change of layout for a reader writes: the next kind of reader chains behind it, and keeps
// waiting for the shader that wrote.
TEST(Barriers, ReadersInDifferentLayoutsFollowEachOther)
{
    ResourceState state = after({Use::ColorTarget}, kImage);
    const auto sampled = advance(state, Use::Sampled, kImage);
    ASSERT_TRUE(sampled);
    EXPECT_EQ(sampled->from_stages, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT);
    EXPECT_EQ(sampled->from_access, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
    const auto storage = advance(state, Use::StorageRead, kImage);
    ASSERT_TRUE(storage);
    EXPECT_EQ(storage->from_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_EQ(storage->to_layout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(storage->from_stages, needs_of(Use::Sampled).stages) << "all readers are done";
    const auto host = advance(state, Use::HostRead, kImage);
    ASSERT_TRUE(host) << "same layout, but the transition is not yet visible to the host";
    EXPECT_EQ(host->from_stages, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
}

// The image is written, then read through a buffer on its memory; what writes the image next waits for that.
TEST(Barriers, RowsWaitForTheirImageAndItForThem)
{
    ResourceState image = after({Use::StorageWrite}, kImage);
    const auto shown = advance(image, Use::SeenAsRows, kImage);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->from_access, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    EXPECT_EQ(shown->to_stages, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    ResourceState rows;
    advance(rows, Use::RowsOfImage, kBuffer);
    const auto read = advance(rows, Use::TexelRead, kBuffer);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->from_stages, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
    EXPECT_EQ(read->from_access, VK_ACCESS_2_MEMORY_WRITE_BIT);
    const auto again = advance(image, Use::StorageWrite, kImage);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->from_stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
}

TEST(Barriers, WritersAndReadersAreToldApart)
{
    for (const Use use :
         {Use::ColorTarget, Use::DepthTarget, Use::StorageWrite, Use::TransferTarget}) {
        EXPECT_TRUE(needs_of(use).writes);
    }
    for (const Use use : {Use::Sampled, Use::StorageRead, Use::TexelRead, Use::UniformRead,
                          Use::TransferSource, Use::HostRead}) {
        EXPECT_FALSE(needs_of(use).writes);
    }
}

}  // namespace
}  // namespace petrichor::gpu
