#include "needs/minimal_plan.h"
