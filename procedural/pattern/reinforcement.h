// Reinforcement: how bridges are chosen that make a pattern sounder.
#pragma once

namespace lamella {

/// Beyond the bridges that join pieces.
enum class Reinforcement : unsigned char {
    none,
    shape,  ///< by the pattern alone, see plan_bridges()
    forces  ///< by how the pattern deforms under loads, see BridgesByForces
};

}  // namespace lamella
