/* Frequency and decay of a damped oscillation in a series of samples. */
#ifndef RUN_OSCILLATION_H
#define RUN_OSCILLATION_H

#include "core/status.h"

/** Fits c + d t + exp(-decay t) (a cos wt + b sin wt) to v [n] at times t [n] s, increasing, by least squares; samples
 *  near the ends of the span count less (Hann's window), so that overtones do not pull at the result. frequency Hz,
 *  decay 1/s. ERR_INPUT: fewer than 16 samples or less than one oscillation. */
enum status oscillation_fit(long n, const double *t, const double *v, double *frequency, double *decay) MUST_CHECK;

#endif
