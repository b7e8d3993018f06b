/* Amounts of mass, momentum and energy: measured by the modules, compared by run/. */
#ifndef CORE_LEDGER_H
#define CORE_LEDGER_H

enum ledger_entry {
#define LEDGER(name, unit, meaning) LEDGER_##name,
#include "core/ledger.def"
#undef LEDGER
  N_LEDGER
};

struct ledger {
  double v[N_LEDGER];
};

#endif
