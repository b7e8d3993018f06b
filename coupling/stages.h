/* The stages of the coupling; module.c lists them. */
#ifndef COUPLING_STAGES_H
#define COUPLING_STAGES_H

#include "coupling/coupling.h"

/** Rooms of nodes beside obstacles that are there at time t. */
void        coupling_find_rooms(const struct sim *sim, struct coupling *c, double t);
enum status coupling_gather_volumes(struct sim *sim, double dt);
enum status coupling_gather_media(struct sim *sim, double dt);
enum status coupling_push_solid(struct sim *sim, double dt);

#endif
