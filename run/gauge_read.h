/* Readers: a gauge of the scene made ready to give its number at any time. */
#ifndef RUN_GAUGE_READ_H
#define RUN_GAUGE_READ_H

#include "run/fields.h"

/* Gives the markers [first, end) of a load or tracer; first = end: none. */
struct marker_finder {
  void (*range)(const struct sim *sim, const char *name, long *first, long *end);
};

struct gauge_extent; /* run/gauge_extent.c */

/* One column of gauges.csv. */
struct gauge_reader {
  char name[NAME_LENGTH + 16], unit[NAME_LENGTH];
  double (*read)(const struct gauge_reader *reader, const struct sim *sim);
  struct field_view    view;
  int                  component;
  double               x[3];    /* m: where a point is read */
  long                 cell[8]; /* cells around x and what each counts */
  double               weight[8];
  const struct shape  *region;  /* of means and integrals */
  long                 n_cells; /* owned cells whose centre lies in the region */
  long                *cells;
  struct field_view    volume; /* of points: what means and integrals weigh them with; data NULL: unknown */
  struct field_view    start;  /* of markers: where they were at the start */
  int                  ledger;
  int                  axis;       /* of a level: along which it is taken */
  const double        *number;     /* of a wall */
  long                 first, end; /* markers */
  struct gauge_extent *extent;     /* NULL: not of that kind */
};

/** Number of columns of a gauge: the samples of a line, else 1. */
int gauge_columns(const struct gauge *gauge);
/** Column `sample` of a gauge. ERR_INPUT: an unknown field, load or tracer, a region without cells, ... */
enum status gauge_reader_create(const struct sim *sim, const struct gauge *gauge, int sample,
                                const struct marker_finder *markers, struct gauge_reader *reader) MUST_CHECK;
void        gauge_reader_destroy(struct gauge_reader *reader);
/** m: place of a gauge, or of sample `sample` of a line; null is the middle of an axis. */
void gauge_reader_place(const struct grid *g, const struct gauge *gauge, int sample, double x[3]);
/** Cells around reader->x and what each counts. */
void gauge_reader_weigh(const struct grid *g, struct gauge_reader *reader);
/** The number now, at the end of a step; NaN where there is nothing to read. */
double gauge_reader_read(struct gauge_reader *reader, const struct sim *sim);

#endif
