// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"

namespace batten {

/// A value of a STEP file (ISO 10303-21). Lists and typed values have others in them.
struct StepValue {
  enum class Kind { Number, Text, Word, Reference, List, Missing };
  Kind kind = Kind::Missing;
  double number = 0.0;                 ///< Number; the id of a Reference.
  std::string_view text;               ///< Text as it is written, a Word such as T or MILLI, the type of a typed value.
  std::uint32_t first = 0, count = 0;  ///< List, typed value: its values in StepRecords::lists.
};

/// One record of an instance: a name and its values. An instance of several types has several.
struct StepRecord {
  std::string_view type;
  std::uint32_t first = 0, count = 0;  ///< In StepRecords::lists.
};
struct StepInstance {
  std::uint32_t first = 0, count = 0;  ///< Its records.
};

/// The data section of a file, taken apart. Views point into the text, which has to outlive it.
struct StepRecords {
  std::vector<StepValue> lists;  ///< All values, those of one list side by side.
  std::vector<StepRecord> records;
  std::unordered_map<std::uint64_t, StepInstance> instances;
  std::vector<std::uint64_t> order;  ///< Ids as they come in the file.
};

/// Reads in time and memory in proportion to the text; lists may lie 32 deep.
/// @return BadParameter if it is no STEP file or damaged: the message says where. Cancelled.
Result<StepRecords> readStepRecords(std::string_view text, const RunContext& context);

/// A text of the file as UTF-8: '' is an apostrophe, \X2\…\X0\ and \X\hh are letters beyond ASCII.
std::string stepText(std::string_view written);

}  // namespace batten
