#ifndef PETRICHOR_CLI_ROOMS_H
#define PETRICHOR_CLI_ROOMS_H

// The program is the one user of these rooms' names; here they need no prefix.
namespace petrichor::film {
}
namespace petrichor::cli {
using namespace petrichor::film;
}

#endif
