// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/target/target_courses.h"

#include "core/curve/curvature.h"
#include "core/fairing/model/coarse_setups.h"

namespace batten {

int TargetCourses::sketchedExtrema() {
  if (!sketchedExtrema_) sketchedExtrema_ = countedExtrema(sketch().original, sketch().closed, sketch().check);
  return *sketchedExtrema_;
}

const TargetCourse& TargetCourses::own(double mostMm) {
  follow(own_, mostMm);
  return own_;
}

const std::vector<TargetCourse>& TargetCourses::calm(double mostMm) {
  if (!hasCalm_) {
    for (auto& setup : calmSetups(own_.setup)) calm_.push_back({std::move(setup), nullptr});
    hasCalm_ = true;
  }
  for (TargetCourse& course : calm_) follow(course, mostMm);
  return calm_;
}

void TargetCourses::follow(TargetCourse& course, double mostMm) const {
  if (course.followed) {
    course.followed->reach(mostMm);
  } else {
    course.followed = std::make_unique<TargetSteps>(*course.setup, *objective_, context_, mostMm);
  }
}

}  // namespace batten
