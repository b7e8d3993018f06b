/* references.csv: what the references say of the gauges that metrics compare with them. */
#include "run/files.h"
#include "run/gauges.h"
#include "run/metric_parts.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

/* rows at most: references may be long sums */
enum { MOST_ROWS = 400 };

/* a gauge against a reference, as it is: not its frequency, its decay, ... */
static bool has_curve(const struct compiled_metric *m)
{
  int measure = m->metric->measure;
  return *m->metric->gauge && m->expected.reference &&
         (measure == MEASURE_VALUE || measure == MEASURE_MEAN || measure == MEASURE_RMS || measure == MEASURE_MAX);
}

/* the first metric of its gauge and reference draws the curve */
static bool is_first(const struct compiled_metric *all, int i)
{
  for (int k = 0; k < i; k++)
    if (has_curve(&all[k]) && strcmp(all[k].metric->gauge, all[i].metric->gauge) == 0 &&
        strcmp(all[k].metric->reference, all[i].metric->reference) == 0)
      return false;
  return true;
}

static enum status write_row(FILE *file, int n, const struct compiled_metric *all, double t)
{
  fprintf(file, "%.10g", t);
  for (int i = 0; i < n; i++) {
    double v;
    if (!has_curve(&all[i]) || !is_first(all, i)) continue;
    TRY(expectancy_values(&all[i].expected, 1, (const double(*)[3])all[i].x, t, &v));
    fprintf(file, ",%.10g", v - all[i].metric->offset);
  }
  fprintf(file, "\n");
  return OK;
}

static enum status write_rows(FILE *file, int n, const struct compiled_metric *all, const struct gauges *gauges,
                              const char *any)
{
  const double *t, *v;
  long          samples;
  TRY(gauges_series(gauges, any, &samples, &t, &v));
  fprintf(file, "t [s]");
  for (int i = 0; i < n; i++)
    if (has_curve(&all[i]) && is_first(all, i))
      fprintf(file, ",%s (%s) [%s]", all[i].metric->gauge, all[i].metric->reference,
              gauges_unit(gauges, all[i].metric->gauge));
  fprintf(file, "\n");
  for (long k = 0; k < samples; k += 1 + samples / MOST_ROWS) TRY(write_row(file, n, all, t[k]));
  return OK;
}

enum status metric_curves_write(int n, const struct compiled_metric *all, const struct gauges *gauges,
                                const char *folder)
{
  char        path[LONGEST_PATH], part[LONGEST_PATH + 4];
  const char *any = NULL;
  for (int i = 0; i < n && !any; i++)
    if (has_curve(&all[i])) any = all[i].metric->gauge;
  if (!any) return OK;
  TRY(files_path(folder, "references.csv", path));
  snprintf(part, sizeof part, "%s.tmp", path);
  FILE *file = fopen(part, "w");
  if (!file) return FAIL(ERR_ENVIRONMENT, "%s: cannot be written: %s; choose another --out", part, strerror(errno));
  enum status status = write_rows(file, n, all, gauges, any);
  if (fclose(file) != 0 && status == OK)
    status = FAIL(ERR_ENVIRONMENT, "%s: %s; free some space", part, strerror(errno));
  TRY(status);
  return files_commit(path);
}
