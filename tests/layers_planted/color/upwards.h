#include "abrdf/direction.h"
