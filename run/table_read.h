/* Tables over time: a column of a CSV file as a function of t. */
#ifndef RUN_TABLE_READ_H
#define RUN_TABLE_READ_H

#include "run/params.h"

/** {"table": "shaking.csv", "column": "v_x", "scale": 1}: the file lies relative to the scene; its first row names the
 *  columns, its first column is t in s and increases. Without "column" the second one counts. */
enum status table_read(struct reader *reader, const cJSON *value, struct function *f) MUST_CHECK;

#endif
