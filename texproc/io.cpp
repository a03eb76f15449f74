#include "texproc/io.h"
