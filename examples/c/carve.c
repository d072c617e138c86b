/* Joins a server of Scree, carves a hole before the eyes of who begins there, and prints what comes of it until it is
 * at rest. usage: carve [HOST [PORT]] */
#include <inttypes.h>
#include <scree/client.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int quit(const char* what) {
  fprintf(stderr, "%s: %s\n", what, scree_error());
  return EXIT_FAILURE;
}

/* Rock in the middle of what is followed, from 50 m above it. */
static scree_result carve(scree_client* client) {
  scree_status status = {.size = sizeof status};
  scree_hit hit = {.size = sizeof hit};
  scree_request carve;
  scree_client_status(client, &status);
  const float from[3] = {status.eye_m[0], status.eye_m[1] + 50.0F, status.eye_m[2]}, down[3] = {0.0F, -1.0F, 0.0F};
  const scree_result found = scree_client_cast(client, from, down, 200.0F, 0.0F, SCREE_MASK_TERRAIN, &hit);
  if (found != SCREE_OK) return found;
  scree_request_init(&carve, sizeof carve, SCREE_CARVE);
  carve.shape.radius_m = 2.0F;
  memcpy(carve.shape.a_m, hit.place_m, sizeof carve.shape.a_m);
  memcpy(carve.place_m, hit.place_m, sizeof carve.place_m);
  printf("carves at %.1f %.1f %.1f\n", hit.place_m[0], hit.place_m[1], hit.place_m[2]);
  return scree_client_request(client, &carve, NULL, NULL, NULL);
}

int main(int argc, char** argv) {
  scree_options options;
  scree_client* client = NULL;
  scree_options_init(&options, sizeof options);
  options.flags |= SCREE_ONCE;
  if (argc > 1) options.host = argv[1];
  if (argc > 2) options.port = (uint32_t)strtoul(argv[2], NULL, 10);
  if (scree_client_create(&options, &client) != SCREE_OK) return quit("no client");

  int asked = 0, answered = 0, quiet = 0;
  while (!answered || quiet < 2) {
    scree_event event = {.size = sizeof event};
    scree_status status = {.size = sizeof status};
    scree_client_poll(client, 100);
    while (scree_client_next(client, &event) == SCREE_OK) {
      if (event.kind == SCREE_EVENT_LOST) {
        fprintf(stderr, "lost: %s\n", event.text);
        scree_client_destroy(client);
        return EXIT_FAILURE;
      }
      if (event.kind == SCREE_EVENT_PIECE_REMOVED) printf("piece %u has become terrain\n", event.id);
      if (event.kind == SCREE_EVENT_STATUS && answered) ++quiet;
      if (event.kind != SCREE_EVENT_REPLY) continue;
      if (*event.text != '\0') printf("refused: %s\n", event.text);
      else printf("%" PRId64 " pieces at tick %" PRIu64 "\n", event.number, event.tick);
      answered = 1;
    }
    scree_client_status(client, &status);
    if (status.pieces != 0) quiet = 0;
    if (!asked && status.loaded && carve(client) == SCREE_OK) asked = 1;
  }
  scree_status status = {.size = sizeof status};
  scree_client_status(client, &status);
  printf("hash %016" PRIx64 ", the server's %016" PRIx64 "\n", status.field_hash, status.server_hash);
  scree_client_destroy(client);
  return EXIT_SUCCESS;
}
