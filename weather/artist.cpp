#include "weather/artist.h"
