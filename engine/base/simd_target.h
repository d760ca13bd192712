// The SIMD target that the kernels run on. Only tests need to know: every target gives the same bits.
#pragma once

#include <string>
#include <vector>

namespace lamella {

/// Returns the names of the SIMD targets that this machine can run, best first.
std::vector<std::string> simd_targets();
/// Makes all kernels use one target of the list until called with an empty name. For tests; not thread-safe.
void force_simd_target(const std::string& name);

}  // namespace lamella
