/* Options of the verbs. */
#include "run/arguments.h"

#include "run/params.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum option { FLUID, SET, REFINE, SWEEP, OUT, THREADS, UNTIL, QUICK, TIME, QUIET, FORCE, MARKDOWN, HELP, N_OPTIONS };

static const struct {
  const char *name, *value, *meaning;
} table[N_OPTIONS] = {
    [FLUID] = {"--fluid", "PATH", "fluid path, such as ice or twopoint; compare, study, stress take several, A,B,..."},
    [SET] = {"--set", "KEY.PATH=VALUE", "overrides one value of the scene; may be given again"},
    [REFINE] = {"--refine", "KEY=V,V,...", "values that one parameter takes, such as h=0.04,0.02; may be given again"},
    [SWEEP] = {"--sweep", "KEY=V,V,...", "an axis of the map, such as dt=0.4,0.8; may be given again"},
    [OUT] = {"--out", "DIR", "output folder; default out/<scene>-<path>"},
    [THREADS] = {"--threads", "N", "number of threads; default as many as the scene keeps busy"},
    [UNTIL] = {"--until", "T", "ends at T seconds instead of at time.end"},
    [QUICK] = {"--quick", NULL, "applies the scene's quick overrides"},
    [TIME] = {"--time", NULL, "prints the time of every stage"},
    [QUIET] = {"--quiet", NULL, "prints nothing but errors"},
    [FORCE] = {"--force", NULL, "overwrites what is there"},
    [MARKDOWN] = {"--markdown", NULL, "prints docs/parameters.md"},
    [HELP] = {"--help", NULL, "prints this"},
};

/** Whether the verb knows the option: --help every verb does. */
static bool knows(const struct verb *verb, int option)
{
  size_t      length = strlen(table[option].name);
  const char *at = verb->options ? strstr(verb->options, table[option].name) : NULL;
  return option == HELP || (at && (at[length] == ' ' || at[length] == '\0'));
}

static enum status fail_option(const struct verb *verb, const char *word)
{
  struct names        names = {0};
  const struct reader reader = {.file = verb->name};
  for (int i = 0; i < N_OPTIONS; i++)
    if (knows(verb, i)) names_add(&names, table[i].name);
  return reader_unknown(&reader, "option", word, &names);
}

/** The option that a word is, up to "="; -1: none that the verb knows. */
static int find_option(const struct verb *verb, const char *word)
{
  size_t length = strcspn(word, "=");
  for (int i = 0; i < N_OPTIONS; i++)
    if (knows(verb, i) && strlen(table[i].name) == length && strncmp(table[i].name, word, length) == 0) return i;
  return -1;
}

static enum status read_number(int option, const char *word, double least, double most, double *number)
{
  char *end;
  errno = 0;
  *number = strtod(word, &end);
  if (end == word || *end != '\0' || errno != 0 || !(*number >= least && *number <= most))
    return FAIL(ERR_INPUT, "%s: \"%s\" is not a number in [%g, %g]; correct it", table[option].name, word, least, most);
  return OK;
}

static enum status read_threads(const char *word, int *threads)
{
  double number = 0;
  TRY(read_number(THREADS, word, 1, 1024, &number));
  *threads = (int)number;
  return number == *threads ? OK : FAIL(ERR_INPUT, "--threads: \"%s\" is not a whole number; round it", word);
}

static enum status store_word(int option, const char *value, int *n, const char *words[], int most)
{
  if (*n == most)
    return FAIL(ERR_INPUT, "%s: more than %d; put overrides into a variant of the scene", table[option].name, most);
  words[(*n)++] = value;
  return OK;
}

static enum status store_value(int option, const char *value, struct run_options *o)
{
  switch (option) {
  case FLUID:
    o->fluid = value;
    return OK;
  case OUT:
    o->out = value;
    return OK;
  case THREADS:
    return read_threads(value, &o->threads);
  case UNTIL:
    return read_number(UNTIL, value, 1e-12, 1e12, &o->until);
  default:
    break;
  }
  return option == SET ? store_word(option, value, &o->n_sets, o->sets, MAX_SETS)
                       : store_word(option, value, &o->n_ladders, o->ladders, MAX_LADDERS);
}

static void store_flag(int option, struct run_options *o, bool *help)
{
  if (option == QUICK) o->quick = true;
  if (option == TIME) o->time = true;
  if (option == QUIET) o->quiet = true;
  if (option == FORCE) o->force = true;
  if (option == MARKDOWN) o->markdown = true;
  if (option == HELP) *help = true;
}

/** Takes words[*i], and the next one if it is the option's value. */
static enum status take_option(const struct verb *verb, int n, char *const words[], int *i, struct run_options *o,
                               bool *help)
{
  int         option = find_option(verb, words[*i]);
  const char *equals = strchr(words[*i], '=');
  if (option < 0) return fail_option(verb, words[*i]);
  if (table[option].value == NULL) {
    if (equals) return FAIL(ERR_INPUT, "%s takes no value; leave \"%s\" out", table[option].name, equals);
    store_flag(option, o, help);
    return OK;
  }
  if (!equals && *i + 1 >= n)
    return FAIL(ERR_INPUT, "%s needs a value; write %s %s", table[option].name, table[option].name,
                table[option].value);
  return store_value(option, equals ? equals + 1 : words[++*i], o);
}

enum status arguments_read(const struct verb *verb, int n, char *const words[], struct run_options *o, bool *help)
{
  *o = (struct run_options){.until = INFINITY};
  *help = false;
  for (int i = 0; i < n; i++) {
    if (strncmp(words[i], "--", 2) == 0) {
      TRY(take_option(verb, n, words, &i, o, help));
    } else if (verb->argument && !o->argument) {
      o->argument = words[i];
    } else {
      return FAIL(ERR_INPUT, "%s: \"%s\" is one argument too many; see mpmice %s --help", verb->name, words[i],
                  verb->name);
    }
  }
  if (verb->argument && !o->argument && !*help)
    return FAIL(ERR_INPUT, "%s: %s is missing; write mpmice %s %s", verb->name, verb->argument, verb->name,
                verb->argument);
  return OK;
}

enum status arguments_find_verb(const char *name, const struct verb **verb)
{
  struct names        names = {0};
  const struct reader reader = {.file = name};
  for (*verb = verbs; (*verb)->name; (*verb)++) {
    names_add(&names, (*verb)->name);
    if (strcmp((*verb)->name, name) == 0) return OK;
  }
  return reader_unknown(&reader, "command", name, &names);
}

void arguments_help(const struct verb *verb, FILE *out)
{
  fprintf(out, "mpmice %s%s%s%s\n\n%s.\n%s", verb->name, verb->argument ? " " : "",
          verb->argument ? verb->argument : "", verb->options ? " [options]" : "", verb->summary, verb->details);
  fprintf(out, "\noptions:\n");
  for (int i = 0; i < N_OPTIONS; i++) {
    char usage[40];
    if (!knows(verb, i)) continue;
    snprintf(usage, sizeof usage, "%s %s", table[i].name, table[i].value ? table[i].value : "");
    fprintf(out, "  %-24s %s\n", usage, table[i].meaning);
  }
}

void arguments_help_all(FILE *out)
{
  fprintf(out, "mpmice: deformable porous solids in water, with material points\n\n");
  for (const struct verb *v = verbs; v->name; v++) {
    char usage[40];
    snprintf(usage, sizeof usage, "%s %s", v->name, v->argument ? v->argument : "");
    fprintf(out, "  mpmice %-16s %s\n", usage, v->summary);
  }
  fprintf(out, "\nmpmice COMMAND --help tells the options of a command, mpmice --version the version.\n"
               "SCENE is the path of a .json or the name of a shipped case (mpmice list), with +variant[+variant].\n"
               "Exit status: 0 done, 1 a metric missed its limit, 2 bad input, 3 numerical failure,\n"
               "4 environment (disk, memory), 130 interrupted with a checkpoint written.\n");
}
