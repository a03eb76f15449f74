// Lists the pixels that the pass of reflections is about: a CPU would do its work for all others, too. The order of
// the list decides no pixel.
void list_mirror(bool mirrors, ivec2 texel)
{
    const uvec4 asked = subgroupBallot(mirrors);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(mirror_count, subgroupBallotBitCount(asked));
    first = subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(asked);
    if (mirrors) mirror_pixels[first] = uint(texel.y) * 65536u + uint(texel.x);
}
