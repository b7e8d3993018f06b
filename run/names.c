/* Names that are known, and the nearest of them to a wrong one. */
#include "run/params.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 63 };

static int smaller(int a, int b) { return a < b ? a : b; }

/** Edits (insert, delete, replace, swap of neighbours) from a to b, regardless of case; long names are cut. */
static int edit_distance(const char *a, const char *b)
{
  int cost[LONGEST + 1][LONGEST + 1] = {{0}};
  int n = smaller((int)strlen(a), LONGEST), m = smaller((int)strlen(b), LONGEST);
  for (int i = 0; i <= n; i++) cost[i][0] = i;
  for (int j = 0; j <= m; j++) cost[0][j] = j;
  for (int i = 1; i <= n; i++)
    for (int j = 1; j <= m; j++) {
      int differs = tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]);
      int best = smaller(smaller(cost[i - 1][j], cost[i][j - 1]) + 1, cost[i - 1][j - 1] + differs);
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) best = smaller(best, cost[i - 2][j - 2] + 1);
      cost[i][j] = best;
    }
  return cost[n][m];
}

/** The nearest name, if it is near at all; NULL. */
static const char *nearest(const struct names *names, const char *wrong)
{
  const char *best = NULL;
  int         least = (int)strlen(wrong) / 2 + 2;
  for (int i = 0; i < names->n; i++) {
    bool begins = *wrong && strncmp(names->name[i], wrong, strlen(wrong)) == 0;
    int  distance = begins ? 1 : edit_distance(wrong, names->name[i]);
    if (distance < least) {
      least = distance;
      best = names->name[i];
    }
  }
  return best;
}

void names_add(struct names *names, const char *name)
{
  for (int i = 0; i < names->n; i++)
    if (strcmp(names->name[i], name) == 0) return;
  if (names->n < (int)(sizeof names->name / sizeof *names->name)) names->name[names->n++] = name;
}

void names_add_table(struct names *names, const struct param *table)
{
  for (const struct param *p = table; p && p->name; p++) names_add(names, p->name);
}

void names_add_words(struct names *names, const char *words, char *buffer, size_t size)
{
  snprintf(buffer, size, "%s", words);
  for (char *word = buffer, *end; word; word = end) {
    end = strchr(word, '|');
    if (end) *end++ = '\0';
    names_add(names, word);
  }
}

enum status reader_unknown(const struct reader *reader, const char *what, const char *wrong, const struct names *names)
{
  char        list[600] = "";
  size_t      length = 0;
  const char *best = nearest(names, wrong);
  for (int i = 0; i < names->n && length < sizeof list; i++)
    length += (size_t)snprintf(list + length, sizeof list - length, "%s%s", i ? ", " : "", names->name[i]);
  if (names->n == 0) return reader_fail(reader, "unknown %s \"%.60s\"; there is none to choose from", what, wrong);
  if (!best) return reader_fail(reader, "unknown %s \"%.60s\"; valid are: %s", what, wrong, list);
  return reader_fail(reader, "unknown %s \"%.60s\"; did you mean \"%s\"? valid are: %s", what, wrong, best, list);
}
