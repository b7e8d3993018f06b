/* Error codes and how an error travels: TRY hands it up, FAIL makes one. Only run/main.c prints and exits. */
#ifndef CORE_STATUS_H
#define CORE_STATUS_H

enum status {
#define STATUS(code, exit_status, meaning) code,
#include "core/status.def"
#undef STATUS
};

#define MUST_CHECK __attribute__((warn_unused_result))

/** Records a message (what, where, value, remedy: one sentence) and returns `code`. */
enum status status_fail(enum status code, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** The message of the last FAIL; "" if none. */
const char *status_message(void);
/** Exit status of the program for a code. */
int status_exit(enum status code);

#define FAIL(code, ...) status_fail(code, __VA_ARGS__)
#define TRY(call)                                                                                                      \
  do {                                                                                                                 \
    enum status status_ = (call);                                                                                      \
    if (status_ != OK) return status_;                                                                                 \
  } while (0)

#endif
