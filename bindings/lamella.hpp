// Everything of Lamella that C++ programs build on. Installed as <lamella/lamella.hpp>; each header below can
// be included alone, as <lamella/engine/field/field.h>.
//
//     using namespace lamella;
//     Job job;
//     job.part = make_sphere({0, 0, 0}, 10);
//     job.bounds = job.part->bounds();
//     job.layer_count = count_layers(20, job.layer_height);
//     for (int i = 0; i < job.layer_count; ++i) use(Layer(job, i).contours(0.05));
#pragma once

#include "engine/base/cancel_token.h"
#include "engine/base/error.h"
#include "engine/base/geometry.h"
#include "engine/contours/contours.h"
#include "engine/field/field.h"
#include "engine/field/grading.h"
#include "engine/formula/formula_field.h"
#include "engine/io/mesh_reader.h"
#include "engine/layers/backend.h"
#include "engine/layers/layer.h"
#include "engine/layers/layer_stream.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"
#include "printers/common/profile.h"
#include "printers/registry.h"
#include "procedural/foam/closed_foam.h"
#include "procedural/foam/nearest_foam.h"
#include "procedural/foam/voronoi_foam.h"
#include "procedural/lattice/strut_lattice.h"
#include "procedural/lattice/tpms.h"
#include "recipe/build/build_job.h"
#include "recipe/read_recipe.h"
#include "recipe/recipe.h"
