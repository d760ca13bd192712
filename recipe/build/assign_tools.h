// Which tools (extruders) make the parts of a job.
#pragma once

#include "recipe/build/build_job.h"

namespace lamella {

/// Gives the job the zones of the tools that part, foam, skin, regions and supports name; none where all is
/// made by the first tool. Supports and shield must have been added. Throws InputError for a tool that the
/// machine does not have, and for a body whose skin has no closed form.
void assign_tools(const Recipe& recipe, BuiltJob& built);

}  // namespace lamella
