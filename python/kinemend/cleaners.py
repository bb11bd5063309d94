"""A function for each cleaning method, whose arguments are the options of the method.

>>> kinemend.clean(kinemend.read("walk.bvh"), kinemend.cleaners.gaussian(width_s=0.03)).report.method
'gaussian'

Made by tools/make_python_tables from the table of methods.
"""

from __future__ import annotations

import os
from typing import Literal

from ._tables import Cleaner


def auto(
    *,
    sensitivity: float = 1.0,
    despike: bool = True,
) -> Cleaner:
    """Measures the noise of each joint or marker, repairs spikes, smooths by the measured noise,
    and leaves clean takes unchanged.

    After Kinemend; smoothing by evidence after Eilers 2003 and Wahba 1985.

    Parameters
    ----------
    sensitivity : float, default 1.0
        Factor on the estimated noise: above 1 smooths more, below 1 less, 0 not at all (0 to 4).
    despike : bool, default True
        Find and repair spikes.
    """
    return Cleaner("auto", {"sensitivity": sensitivity, "despike": despike})


def bilateral(
    *,
    sigma_t_s: float = 0.01,
    sigma_g_deg: float = 8.0,
    passes: int = 5,
    ends: Literal["reflect", "mirror"] = "reflect",
) -> Cleaner:
    """Edge-preserving average of rotations: smooths slow motion and keeps quick moves.

    After Courty 2008, Bilateral Human Motion Filtering.

    Parameters
    ----------
    sigma_t_s : float, default 0.01
        Standard deviation of the weights in time (s, 0.001 to 1).
    sigma_g_deg : float, default 8.0
        Standard deviation of the weights in rotation angle; much larger turns are kept (deg, 0.01
        to 1000).
    passes : int, default 5
        How many times the filter runs (1 to 100).
    ends : {"reflect", "mirror"}, default "reflect"
        Padding at the ends of the take: reflect continues a steady turn, mirror runs back in time.
    """
    return Cleaner(
        "bilateral",
        {
            "sigma_t_s": sigma_t_s,
            "sigma_g_deg": sigma_g_deg,
            "passes": passes,
            "ends": ends,
        },
    )


def nonlocal_(
    *,
    window_s: float = 0.175,
    patch_s: float = 0.092,
    neighbours: int = 0,
    bandwidth_deg: float = 0.0,
    boundary: Literal["neumann", "mirror", "dirichlet"] = "neumann",
    causal: bool = False,
) -> Cleaner:
    """Averages poses that occur in similar stretches of motion.

    After Dean 2016, Non-local Pose Means for Denoising Motion Capture Data.

    Parameters
    ----------
    window_s : float, default 0.175
        Length of the window that is searched for similar poses; 0: the whole take (s, 0 to 60).
    patch_s : float, default 0.092
        Length of the stretch of motion (patch) that is compared (s, 0 to 10).
    neighbours : int, default 0
        Number of similar poses that are averaged; 0: all poses of the window (0 to 1e+06).
    bandwidth_deg : float, default 0.0
        Difference per channel beyond which poses count little; 0: from the noise (deg, 0 to 180).
    boundary : {"neumann", "mirror", "dirichlet"}, default "neumann"
        Padding at the ends: neumann continues the motion, mirror runs back in time, dirichlet holds
        the pose.
    causal : bool, default False
        Use past poses only, for live use.
    """
    return Cleaner(
        "nonlocal",
        {
            "window_s": window_s,
            "patch_s": patch_s,
            "neighbours": neighbours,
            "bandwidth_deg": bandwidth_deg,
            "boundary": boundary,
            "causal": causal,
        },
    )


def gaussian(
    *,
    width_s: float = 0.02,
) -> Cleaner:
    """Smoothing with Gaussian weights in time, made for rotations.

    After Lee & Shin 2002; Courty 2008, eq. 2-3.

    Parameters
    ----------
    width_s : float, default 0.02
        Standard deviation of the Gaussian weights (s, 0 to 1).
    """
    return Cleaner("gaussian", {"width_s": width_s})


def butterworth(
    *,
    order: int = 4,
    cutoff_hz: float = 8.0,
) -> Cleaner:
    """Low-pass filter with a fixed cutoff, run forward and backward so that nothing is delayed.

    After Butterworth 1930; the usual filter of biomechanics (Winter 1974).

    Parameters
    ----------
    order : int, default 4
        Filter order of each of the two passes (1 to 12).
    cutoff_hz : float, default 8.0
        Cutoff of one pass (half power); must be below half of the frame rate (Hz, 0.05 to 500).
    """
    return Cleaner("butterworth", {"order": order, "cutoff_hz": cutoff_hz})


def median(
    *,
    window_s: float = 0.06,
) -> Cleaner:
    """Running median: removes short spikes and keeps sudden moves.

    After Tukey 1977; the median of rotations is Hartley et al.'s L1 mean (2011).

    Parameters
    ----------
    window_s : float, default 0.06
        Length of the whole window (s, 0.001 to 2).
    """
    return Cleaner("median", {"window_s": window_s})


def hampel(
    *,
    window_s: float = 0.1,
    threshold: float = 5.0,
    minimum_deg: float = 1.0,
) -> Cleaner:
    """Replaces spikes by the median of their window; all other samples stay unchanged.

    After Hampel 1974; Davies & Gather 1993.

    Parameters
    ----------
    window_s : float, default 0.1
        Length of the whole window (s, 0.01 to 5).
    threshold : float, default 5.0
        A sample farther from the median than this many robust deviations is a spike (0 to 100).
    minimum_deg : float, default 1.0
        Smallest distance from the median that counts as a spike (deg, 0 to 180).
    """
    return Cleaner(
        "hampel",
        {
            "window_s": window_s,
            "threshold": threshold,
            "minimum_deg": minimum_deg,
        },
    )


def wavelet(
    *,
    family: Literal["db1", "db2", "db3", "db4", "db5", "db6", "db7", "db8", "db9", "db10", "sym2", "sym3", "sym4", "sym5", "sym6", "sym7", "sym8", "sym9", "sym10"] = "sym8",
    threshold: Literal["universal", "sure"] = "sure",
    shrinkage: Literal["soft", "hard"] = "soft",
) -> Cleaner:
    """Wavelet shrinkage: adapts to the noise and keeps sudden motion.

    After Donoho & Johnstone 1994, 1995.

    Parameters
    ----------
    family : {"db1", "db2", "db3", "db4", "db5", "db6", "db7", "db8", "db9", "db10", "sym2", "sym3",
    "sym4", "sym5", "sym6", "sym7", "sym8", "sym9", "sym10"}, default "sym8"
        Wavelet: db (Daubechies) or sym (symlet) with its number of vanishing moments.
    threshold : {"universal", "sure"}, default "sure"
        Universal removes more noise, and small detail with it; sure adapts to each scale.
    shrinkage : {"soft", "hard"}, default "soft"
        Soft also shrinks the coefficients that stay; hard keeps them unchanged.
    """
    return Cleaner("wavelet", {"family": family, "threshold": threshold, "shrinkage": shrinkage})


def weighted_mean(
    *,
    passes: int = 4,
) -> Cleaner:
    """Weighted moving mean of five frames, like Smooth Keys in Blender.

    After Smooth Keys of Blender's graph editor.

    Parameters
    ----------
    passes : int, default 4
        How many times the five-frame mean is applied (1 to 100).
    """
    return Cleaner("weighted-mean", {"passes": passes})


def kalman(
    *,
    model: Literal["position", "velocity"] = "velocity",
    smoother: bool = True,
    noise_deg: float = 0.0,
    agility: float = 1.0,
) -> Cleaner:
    """Kalman smoother or live filter that assumes steady motion.

    After Kalman 1960; Rauch, Tung & Striebel 1965; baseline of Lou & Chai 2010.

    Parameters
    ----------
    model : {"position", "velocity"}, default "velocity"
        The quantity that is assumed to change little from frame to frame.
    smoother : bool, default True
        Use the whole take; off: past frames only, which can run live.
    noise_deg : float, default 0.0
        Standard deviation of the noise per axis; 0: estimated from the take (deg, 0 to 45).
    agility : float, default 1.0
        How quickly the motion may change, 1: everyday motion; larger follows more closely (0.01 to
        100).
    """
    return Cleaner(
        "kalman",
        {
            "model": model,
            "smoother": smoother,
            "noise_deg": noise_deg,
            "agility": agility,
        },
    )


def example(
    *,
    model: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
    solver: Literal["quick", "paper"] = "quick",
    robust: bool = True,
    welsch_deg: float = 0.0,
    lambda_: float = 0.0,
    bases: int = 0,
    iterations: int = 1000,
    tolerance: float = 0.01,
    fill_gaps: bool = True,
) -> Cleaner:
    """Keeps the motion that patterns learned from clean clips can express.

    After Lou & Chai 2010, Example-based Human Motion Denoising.

    Parameters
    ----------
    model : str, default ""
        Model file made by kinemend train example; empty: the model that ships.
    map : str, default ""
        File that maps names in the take to names in the model.
    solver : {"quick", "paper"}, default "quick"
        Paper: the algorithm of the paper, with welsch_deg 3 and lambda 0.1 unless set.
    robust : bool, default True
        Give outliers less weight; off: linear filter, all samples count alike.
    welsch_deg : float, default 0.0
        Distance from the estimate at which a sample loses weight; 0: from the noise (deg, 0 to
        180).
    lambda_ : float, default 0.0
        Weight of the learned patterns against the measurements; 0: from noise and model (0 to
        1e+06).
    bases : int, default 0
        Number of filter bases; 0: all of the model (0 to 100000).
    iterations : int, default 1000
        Largest number of iterations (1 to 10000).
    tolerance : float, default 0.01
        Stop when an iteration improves less than this share; a thousandth of it with gaps (0 to 1).
    fill_gaps : bool, default True
        Fill gaps of joints or markers that the model knows.
    """
    return Cleaner(
        "example",
        {
            "model": model,
            "map": map,
            "solver": solver,
            "robust": robust,
            "welsch_deg": welsch_deg,
            "lambda": lambda_,
            "bases": bases,
            "iterations": iterations,
            "tolerance": tolerance,
            "fill_gaps": fill_gaps,
        },
    )


def wiener(
    *,
    model: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
    noise_deg: float = 0.0,
    sensitivity: float = 1.0,
    despike: bool = True,
    fill_gaps: bool = True,
) -> Cleaner:
    """Estimates short stretches of motion from what was learned of motion and noise.

    After a stronger linear prior than Lou & Chai 2010.

    Parameters
    ----------
    model : str, default ""
        Model file made by kinemend train wiener; empty: the model that ships.
    map : str, default ""
        File that maps names in the take to names in the model.
    noise_deg : float, default 0.0
        Standard deviation of the noise per channel; 0: estimated from the take (deg, 0 to 45).
    sensitivity : float, default 1.0
        Factor on the noise: above 1 smooths more, below 1 less, 0 not at all (0 to 4).
    despike : bool, default True
        Find and repair spikes.
    fill_gaps : bool, default True
        Fill gaps of joints or markers that the model knows.
    """
    return Cleaner(
        "wiener",
        {
            "model": model,
            "map": map,
            "noise_deg": noise_deg,
            "sensitivity": sensitivity,
            "despike": despike,
            "fill_gaps": fill_gaps,
        },
    )


def sparse(
    *,
    model: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
    loss: Literal["mixed", "l2", "l1"] = "mixed",
    lambda_: float = 0.1,
    hops: int = 4,
    solver: Literal["quick", "paper"] = "quick",
    fill_gaps: bool = True,
) -> Cleaner:
    """Rebuilds each part of the body from a few learned pieces of motion.

    After Xiao et al. 2015, Sparse motion bases selection for human motion denoising.

    Parameters
    ----------
    model : str, default ""
        Model file made by kinemend train sparse; empty: the model that ships.
    map : str, default ""
        File that maps names in the take to names in the model.
    loss : {"mixed", "l2", "l1"}, default "mixed"
        L2: for noise; l1: for outliers; mixed: l1 finds outliers, then l2 removes the noise.
    lambda_ : float, default 0.1
        Sparsity: a larger one uses fewer learned pieces and smooths more (0 to 1000).
    hops : int, default 4
        Number of overlapping windows that are averaged in each frame (1 to 1000).
    solver : {"quick", "paper"}, default "quick"
        Paper: the algorithm of the paper alone, without later corrections.
    fill_gaps : bool, default True
        Fill gaps of joints or markers that the model knows.
    """
    return Cleaner(
        "sparse",
        {
            "model": model,
            "map": map,
            "loss": loss,
            "lambda": lambda_,
            "hops": hops,
            "solver": solver,
            "fill_gaps": fill_gaps,
        },
    )


def kalman_learned(
    *,
    model: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
    smoother: bool = True,
    noise_deg: float = 0.0,
    fill_gaps: bool = True,
) -> Cleaner:
    """Kalman smoother with a model of motion that was learned from clean clips.

    After data-driven Kalman filter of Lou & Chai 2010, section 4.2.

    Parameters
    ----------
    model : str, default ""
        Model file made by kinemend train kalman-learned (required; none ships).
    map : str, default ""
        File that maps names in the take to names in the model.
    smoother : bool, default True
        Use the whole take; off: past frames only.
    noise_deg : float, default 0.0
        Standard deviation of the noise per channel; 0: estimated from the take (deg, 0 to 45).
    fill_gaps : bool, default True
        Fill gaps of joints or markers that the model knows.
    """
    return Cleaner(
        "kalman-learned",
        {
            "model": model,
            "map": map,
            "smoother": smoother,
            "noise_deg": noise_deg,
            "fill_gaps": fill_gaps,
        },
    )


def recurrent(
    *,
    model: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
    fill_gaps: bool = True,
    gap_model: str | os.PathLike[str] = "",
    live: bool = False,
) -> Cleaner:
    """Neural network that predicts a filter for each joint and frame.

    After Mall et al. 2017.

    Parameters
    ----------
    model : str, default ""
        Model file made by kinemend-train paper; empty: the model that ships.
    map : str, default ""
        File that maps names in the take to names in the model.
    fill_gaps : bool, default True
        Fill gaps of joints that the model knows.
    gap_model : str, default ""
        Model file of a network (EBD) that fills gaps before a filter network (EBF) runs.
    live : bool, default False
        Live form of a filter network (EBF): looks 15 frames ahead.
    """
    return Cleaner(
        "recurrent",
        {
            "model": model,
            "map": map,
            "fill_gaps": fill_gaps,
            "gap_model": gap_model,
            "live": live,
        },
    )


def learned(
    *,
    model: str | os.PathLike[str] = "",
    map: str | os.PathLike[str] = "",
    live: bool = False,
) -> Cleaner:
    """Network that reads the take itself and finds noise of every kind, slow noise too.

    After Kinemend; damage as in Mall et al. 2017, smoothers mixed by a network.

    Parameters
    ----------
    model : str, default ""
        Model file made by kinemend-train learned; empty: the model that ships.
    map : str, default ""
        File that maps names in the take to names in the model.
    live : bool, default False
        Live form: looks an eighth of a second ahead.
    """
    return Cleaner("learned", {"model": model, "map": map, "live": live})


def one_euro(
    *,
    min_cutoff_hz: float = 1.5,
    speed_coefficient: float = 10.0,
    speed_cutoff_hz: float = 4.0,
) -> Cleaner:
    """Live filter that smooths much at rest and little in motion.

    After Casiez, Roussel & Vogel 2012.

    Parameters
    ----------
    min_cutoff_hz : float, default 1.5
        Cutoff at rest; a lower one steadies held poses more (Hz, 0.01 to 100).
    speed_coefficient : float, default 10.0
        Increase of the cutoff with speed, Hz per radian/s; a higher one delays motion less (0 to
        1000).
    speed_cutoff_hz : float, default 4.0
        Cutoff of the low-pass filter on the measured speed (Hz, 0.01 to 100).
    """
    return Cleaner(
        "one-euro",
        {
            "min_cutoff_hz": min_cutoff_hz,
            "speed_coefficient": speed_coefficient,
            "speed_cutoff_hz": speed_cutoff_hz,
        },
    )
