// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/construct/pieces.h"

namespace batten {

/// What the teeth of the paper do to the centre line of a pencil or brush stroke. They move its two borders, each by
/// itself: half the width then scatters as much as the centre does, and over the same lengths, which are those of the
/// stroke's width and not of a pixel. Measured are the means of the half-width over stretches of one width, pooled over
/// the pieces; what changes evenly along the stroke, a taper, does not count, and no more than the centre itself
/// scatters does, as where a pen swells. Nothing for merged strokes, from too few stretches, or
/// for less than .05 px, as clean pens on rendered pages scatter.
/// The strokes that fill a shape end each where it may: the outline of what a pencil filled scatters over lengths of
/// the pencil's width by itself, no more than half of it. Nothing for other outlines. @param contour in px
StrokeGrain strokeGrain(const ConstructContour& contour);

}  // namespace batten
