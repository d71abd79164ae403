#pragma once
// The quartic box spline on a triangle whose three corners have valence 6.

#include <array>

namespace pelage {

/// Value and derivatives with respect to (v, w), where a point of the triangle is (1-v-w) a + v b + w c.
inline constexpr std::size_t jet_size = 6;  ///< f, f_v, f_w, f_vv, f_vw, f_ww

/// Control points of a regular patch: the corners a, b, c, then the nine outer points counter-clockwise around the
/// triangle: r0 across edge ab; r1, r2 further around b; r3 across bc; r4, r5 around c; r6 across ca; r7, r8 around a.
/// The neighbours of a, counter-clockwise, are thus b, c, r6, r7, r8, r0.
inline constexpr std::size_t regular_points = 12;

using BoxSplineJet = std::array<std::array<double, regular_points>, jet_size>;

/// All twelve basis functions (Stam 1998, appendix A, in this order of points) and their derivatives.
BoxSplineJet box_spline(double v, double w);

}  // namespace pelage
