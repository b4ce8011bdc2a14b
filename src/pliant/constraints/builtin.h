#pragma once
// The list of built-in constraint types: scene files, the docs table, property tests and every other interface are
// written over it. A new type is its pair of files and a line in each of the two lists.
#include <tuple>

#include "pliant/constraints/attachment.h"
#include "pliant/constraints/bending.h"
#include "pliant/constraints/curvature.h"
#include "pliant/constraints/drag.h"
#include "pliant/constraints/edge_spring.h"
#include "pliant/constraints/edge_strain.h"
#include "pliant/constraints/fibre_strain.h"
#include "pliant/constraints/hinge.h"
#include "pliant/constraints/hyperelastic.h"
#include "pliant/constraints/line.h"
#include "pliant/constraints/plane.h"
#include "pliant/constraints/position.h"
#include "pliant/constraints/tetrahedron_strain.h"
#include "pliant/constraints/tetrahedron_volume.h"
#include "pliant/constraints/triangle_area.h"
#include "pliant/constraints/triangle_bending.h"
#include "pliant/constraints/triangle_strain.h"

namespace pliant {

// An entry a line.
// clang-format off

/// What a user asks for.
using BuiltinConstraints = std::tuple<
    Position,
    Line,
    OnPlane,
    InHalfSpace,
    EdgeSpring,
    EdgeStrain,
    Bending,
    HingeBending,
    TriangleBending,
    TriangleStrain,
    FibreStrain,
    TriangleArea,
    TetrahedronStrain,
    TetrahedronVolume,
    TriangleNeoHookean,
    TriangleStvk,
    TetrahedronNeoHookean,
    TetrahedronStvk,
    Drag>;

/// What projects; the others have energies of their own.
using BuiltinProjections = std::tuple<
    PositionProjection,
    LineProjection,
    PlaneProjection,
    HalfSpaceProjection,
    EdgeSpringProjection,
    EdgeEndsProjection,
    EdgeStrainProjection,
    FlatCurvature,
    AbsoluteCurvature,
    SignedFanCurvature,
    SignedHingeCurvature,
    SignedTriangleCurvature,
    TriangleStrainProjection,
    FibreStrainProjection,
    TriangleAreaProjection,
    TetrahedronStrainProjection,
    TetrahedronVolumeProjection,
    DragProjection,
    AttachmentProjection>;

// clang-format on

}  // namespace pliant
