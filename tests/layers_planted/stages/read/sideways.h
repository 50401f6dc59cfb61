#include "stages/write/atlas_writer.h"
