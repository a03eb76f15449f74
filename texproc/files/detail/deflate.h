#ifndef PETRICHOR_TEXPROC_FILES_DETAIL_DEFLATE_H
#define PETRICHOR_TEXPROC_FILES_DETAIL_DEFLATE_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace petrichor::texproc::detail {

/// `data` as deflate blocks (RFC 1951) with codes made for it. Ends on a byte; unless `last`, more
/// blocks may follow, made by other calls that know nothing of this one. Meant for filtered rows of
/// pictures: one look for an earlier place a byte, and codes of every length that the counts ask
/// for. At most 0.1 % larger than the data.
std::vector<std::byte> deflated(std::span<const std::uint8_t> data, bool last);

}  // namespace petrichor::texproc::detail

#endif
