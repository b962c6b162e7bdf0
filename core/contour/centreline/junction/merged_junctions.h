// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/contour/edge_choices.h"

namespace batten {

class SkeletonGraph;
struct SkeletonEdge;
struct SkeletonNode;

/// Whose junctions these are: the crossings of overdrawn strokes with others are all one, too, and in what a pencil
/// drew the paper between strokes is grain.
enum class JunctionsOf { Pen, Pencil, Bundles };

/// Makes one node of junctions that are nearer than their discs allow to tell apart (a crossing at a shallow angle),
/// unless a pen drew around the paper between them.
/// @param choices of the user: where one is meant for a junction of a tangle (tangles.h), that is left as it is.
void mergeJunctions(SkeletonGraph& graph, JunctionsOf, std::span<const JunctionChoice> choices);

/// Whether an edge between two nodes is so short that it lies in their discs: it has no direction of its own.
bool liesInDiscs(const SkeletonEdge&, const SkeletonNode&, const SkeletonNode&);

}  // namespace batten
