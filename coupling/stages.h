/* The stages of the coupling; module.c lists them. */
#ifndef COUPLING_STAGES_H
#define COUPLING_STAGES_H

#include "coupling/coupling.h"

enum status coupling_gather_volumes(struct sim *sim, double dt);
enum status coupling_gather_media(struct sim *sim, double dt);
enum status coupling_push_solid(struct sim *sim, double dt);

#endif
