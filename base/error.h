#ifndef PETRICHOR_BASE_ERROR_H
#define PETRICHOR_BASE_ERROR_H

#include <stdexcept>
#include <string>
#include <utility>

namespace petrichor {

/// The one exception of the project: something that the reader of the message can mend.
///
/// what() names the thing, the value found and the values accepted; fix() is one imperative
/// sentence that says what to do. The program prints both and ends with exit code 2.
class Error : public std::runtime_error {
public:
    Error(const std::string& problem, std::string fix)
        : std::runtime_error(problem), fix_(std::move(fix))
    {
    }

    const std::string& fix() const noexcept { return fix_; }

private:
    std::string fix_;
};

}  // namespace petrichor

#endif
