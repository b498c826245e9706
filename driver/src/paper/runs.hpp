// SPDX-License-Identifier: Apache-2.0
// One function a paper; each in a file of its name.
#pragma once
#include "paper/paper.hpp"

namespace evigrid::driver {

/// Hughes & Murphy 1992: move-to-station.
PaperResult run_hughes1992(const PaperOptions&);
/// Asharif et al. 2001: maps by Dempster and by Bayes, and eight ways planned on them.
PaperResult run_asharif2001(const PaperOptions&);
/// Li, Huang & Dezert 2006, chapter 14: four methods on one drive.
PaperResult run_li2006(const PaperOptions&);
/// Li, Huang, Wang & Dezert 2014: the GERM robot in a dynamic room and in a U-shaped trap.
PaperResult run_li2014(const PaperOptions&);
/// Delafosse et al. 2007: beacons and a TBM grid.
PaperResult run_delafosse2007(const PaperOptions&);

}  // namespace evigrid::driver
