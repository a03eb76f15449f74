#ifndef PETRICHOR_FILM_JOBS_EYES_H
#define PETRICHOR_FILM_JOBS_EYES_H

#include <glm/glm.hpp>
#include <vector>

#include "film/jobs/sequence.h"

namespace petrichor::film {

/// Where the cameras of all views stand over the whole film, 64 moments of it at most, whichever
/// frames are asked for: what is made once for all frames is made for these.
std::vector<glm::vec3> eyes_of(const Sequence& sequence);

}  // namespace petrichor::film

#endif
