#ifndef PETRICHOR_BASE_ORDERED_WORK_H
#define PETRICHOR_BASE_ORDERED_WORK_H

#include <cstddef>
#include <functional>

#include "base/interrupted.h"

namespace petrichor {

/// What is done with each item, by one of several workers (a thread with whatever it works with).
struct OrderedWork {
    using Step = std::function<void(std::size_t worker, std::size_t item)>;
    Step begin;   ///< in the items' order, one at a time
    Step make;    ///< several at a time, one a worker
    Step finish;  ///< in the items' order, one at a time
};

/// Does items 0..count-1 on `workers` threads, of which the caller's is one. Once `stop` says so no
/// item is begun; what was begun is finished. After an exception the items before the one that
/// threw are finished, later ones are not, and it is thrown again (the earliest item's) when all
/// workers have ended.
void run_ordered(std::size_t workers, std::size_t count, const StopRequest& stop, const OrderedWork& work);

}  // namespace petrichor

#endif
