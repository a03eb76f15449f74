#ifndef PETRICHOR_BASE_INTERRUPTED_H
#define PETRICHOR_BASE_INTERRUPTED_H

#include <functional>
#include <stdexcept>

namespace petrichor {

/// Asked between pieces of long work: true when it should end. Empty: never.
using StopRequest = std::function<bool()>;

/// Thrown when a stop was requested; what() says what was kept and how to go on.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace petrichor

#endif
