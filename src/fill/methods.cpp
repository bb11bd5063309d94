#include <array>

#include "kinemend/fill.hpp"

namespace kinemend {

namespace {

constexpr bool yes = true, no = false;

// name, summary, paper, rules, markers, joints
constexpr std::array methods = {
    FillMethod{"auto", "tries the others on gaps made in the take, and takes what does best", "",
               "markers: what is expected to be off by less than an eighth of the body's radius; "
               "joints: what a method's own rule lets it fill, with an expected error of at most "
               "12.5 degrees "
               "(positions: 6 % of the skeleton's height)",
               yes, yes},
    FillMethod{"spline", "natural cubic spline through the samples around the gap", "",
               "both ends are seen; at most 0.25 s", yes, yes},
    FillMethod{
        "quintic", "quintic spline that smooths as cross-validation tells",
        "Woltring 1986, A FORTRAN package for generalized, cross-validatory spline smoothing "
        "and differentiation",
        "both ends are seen; at most 0.25 s", yes, yes},
    FillMethod{"pchip", "shape-preserving cubic: no overshoot",
               "Fritsch & Carlson 1980, Monotone piecewise cubic interpolation",
               "both ends are seen; at most 0.25 s", yes, yes},
    FillMethod{"hermite", "cubic between robust velocities at both ends, which fade in long gaps",
               "", "at most 0.25 s; joints: also 0.1 s at an end of the take", yes, yes},
    FillMethod{"slerp", "the shortest turn between the ends",
               "Shoemake 1985, Animating rotation with quaternion curves",
               "both ends are seen; at most 0.25 s", no, yes},
    FillMethod{"squad", "smooth turn through the samples around the gap",
               "Shoemake 1987, Quaternion calculus and fast animation",
               "both ends are seen; at most 0.25 s", no, yes},
    FillMethod{"pattern", "the movement of a named marker (the donor), moved to meet both ends", "",
               "the donor is seen throughout the gap, and with the marker at both ends; any length",
               yes, no},
    FillMethod{
        "rigid-body", "goes with three or more markers of the same segment",
        "Horn 1987, Closed-form solution of absolute orientation using unit quaternions",
        "three markers, not on one line, are seen throughout the gap, whose distances to the "
        "marker spread by at most 2 % of the body's radius; any length",
        yes, no},
    FillMethod{
        "pca", "regression on the principal components of the take",
        "Gloersen & Federolf 2016, Predicting missing marker trajectories in human motion "
        "data using marker intercorrelations",
        "markers: three others are seen throughout the gap, and 30 frames show all of them with "
        "it, any length; joints: four others are, and 0.5 s and as many frames as the gap has "
        "show all, at most 5 s",
        yes, yes},
    FillMethod{"local-regression",
               "regressions among the markers that keep their distance, averaged by how likely "
               "their distances are",
               "Tits, Tilmanne & Dutoit 2018, Robust and automatic motion-capture data recovery "
               "using soft skeleton constraints and model averaging",
               "three other markers are seen throughout the gap, and 8 frames show them with the "
               "marker; any length",
               yes, no},
    FillMethod{"cyclic", "the same phase of other cycles", "",
               "two other times of the take show the same movement beside the gap, to 35 % of its "
               "size",
               yes, yes},
};

}  // namespace

std::span<const FillMethod> fill_methods() { return methods; }

}  // namespace kinemend
