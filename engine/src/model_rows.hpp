// SPDX-License-Identifier: Apache-2.0
// The one list of models: name, kernel, what it says, its parameters.
#pragma once
#include <span>

#include "params/table.hpp"

namespace evigrid {

enum class Says { masses, probability, memberships };

struct ModelRow {
  Model model;
  std::string_view name;
  int cone;  ///< a kernels::ConeModel; −1: a fan
  Says says;
  std::span<const ParamRow<Sensor>> params;
};

const ModelRow& model_row(Model) noexcept;

}  // namespace evigrid
