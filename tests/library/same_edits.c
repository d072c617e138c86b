/* Carries out every STEP-th edit of a list from the FIRST on, one after another, and prints "done". When the file GO is
 * there, for all clients have done theirs, it waits until the world is at rest, and prints the hash of all edits that the
 * copy has. usage: same_edits PORT LIST FIRST STEP GO */
#include <inttypes.h>
#include <scree/client.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { at_rest = 4, wait_ms = 50 };

static void quit(const char* what, const char* why) {
  fprintf(stderr, "%s: %s\n", what, why);
  exit(EXIT_FAILURE);
}

/* A reply, or the end; keeps how many statuses of a world at rest came in a row. */
struct heard {
  int replied, quiet;
  uint64_t hash;
};

static void poll(scree_client* client, struct heard* heard) {
  scree_event event = {.size = sizeof event};
  scree_status status = {.size = sizeof status};
  if (scree_client_poll(client, wait_ms) != SCREE_OK) quit("poll", scree_error());
  while (scree_client_next(client, &event) == SCREE_OK) {
    if (event.kind == SCREE_EVENT_LOST) quit("lost", event.text);
    if (event.kind == SCREE_EVENT_REPLY) {
      if (*event.text != '\0') quit("refused", event.text);
      heard->replied = 1;
    }
    if (event.kind != SCREE_EVENT_STATUS) continue;
    scree_client_status(client, &status);
    const int same = status.pieces == 0 && status.server_hash == heard->hash && status.field_hash == heard->hash;
    heard->quiet = same ? heard->quiet + 1 : 0;
    heard->hash = status.server_hash;
  }
}

static scree_request read_edit(scree_client* client, char* line) {
  scree_request request;
  const char* const what = strtok(line, " ");
  const char* const shape = strtok(NULL, " ");
  const uint32_t kind = strcmp(what, "carve") == 0 ? SCREE_CARVE : strcmp(what, "fill") == 0 ? SCREE_FILL : SCREE_PAINT;
  scree_request_init(&request, sizeof request, kind);
  for (int i = 0; i < 3; ++i) request.place_m[i] = request.shape.a_m[i] = strtof(strtok(NULL, " "), NULL);
  if (strcmp(shape, "box") == 0) {
    request.shape.kind = SCREE_BOX;
    for (int i = 0; i < 3; ++i) request.shape.b_m[i] = strtof(strtok(NULL, " "), NULL);
  } else {
    request.shape.radius_m = strtof(strtok(NULL, " "), NULL);
  }
  if (kind == SCREE_CARVE) {
    request.seeds = (uint32_t)strtoul(strtok(NULL, " "), NULL, 10);
    request.random_seed = (uint32_t)strtoul(strtok(NULL, " "), NULL, 10);
  }
  if (kind == SCREE_PAINT && scree_client_find_material(client, strtok(NULL, " \n"), &request.material) != SCREE_OK)
    quit("material", scree_error());
  return request;
}

int main(int argc, char** argv) {
  if (argc != 6) quit("usage", "same_edits PORT LIST FIRST STEP GO");
  scree_options options;
  scree_client* client = NULL;
  struct heard heard = {0, 0, 0};
  scree_status status = {.size = sizeof status};
  const long first = strtol(argv[3], NULL, 10), step = strtol(argv[4], NULL, 10);
  scree_options_init(&options, sizeof options);
  options.flags |= SCREE_ONCE;
  options.port = (uint32_t)strtoul(argv[1], NULL, 10);
  if (scree_client_create(&options, &client) != SCREE_OK) quit("no client", scree_error());
  while (!status.loaded || scree_client_material(client, 1, &(scree_material){.size = sizeof(scree_material)}) != SCREE_OK) {
    poll(client, &heard);
    scree_client_status(client, &status);
  }
  FILE* const list = fopen(argv[2], "r");
  char line[200];
  if (list == NULL) quit(argv[2], "cannot be read");
  for (long i = 0; fgets(line, sizeof line, list) != NULL;) {
    if (*line == '#' || i++ % step != first) continue;
    const scree_request request = read_edit(client, line);
    heard.replied = 0;
    if (scree_client_request(client, &request, NULL, NULL, NULL) != SCREE_OK) quit("request", scree_error());
    while (!heard.replied) poll(client, &heard);
  }
  fclose(list);
  puts("done");
  fflush(stdout);
  while (access(argv[5], F_OK) != 0) poll(client, &heard);
  for (heard.quiet = 0; heard.quiet < at_rest;) poll(client, &heard);
  printf("%016" PRIx64 "\n", heard.hash);
  scree_client_destroy(client);
  return EXIT_SUCCESS;
}
