// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/exchange/model/export_model.h"
#include "core/exchange/model/export_settings.h"

namespace batten {

/// The formula of every curve, for Matlab or a spreadsheet: a row per polynomial piece with the parameters it holds
/// for and the coefficients of x and y. x = x0 + x1 t + x2 t^2 + … with t = u - u_start; u is the arc length where the
/// speed of the curve is even, else near it. Curves of lower degree have empty fields at the end.
/// Rational curves, as exact arcs and circles, are written as quintics that lie within 1e-12 of their size.
Result<std::string> writePolynomials(const ExportDocument&, const ExportSettings&, const RunContext& = {});

/// The largest distance of the polynomials from the curves at 200 parameters each, in mm.
Result<double> checkPolynomials(std::string_view text, const ExportDocument&, const ExportSettings&,
                                const RunContext& = {});

}  // namespace batten
