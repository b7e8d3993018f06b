/* Contact between bodies at the nodes they share. */
#ifndef MPM_CONTACT_H
#define MPM_CONTACT_H

#include "mpm/mpm.h"

/** Arrays for the nodes where bodies meet. */
enum status contact_create(struct sim *sim, struct mpm *m) MUST_CHECK;
void        contact_destroy(struct mpm *m);

#endif
