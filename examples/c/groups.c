/* An example for each group of scree/client.h, as its documentation shows them. It strikes the ground of a server and
 * looks at what comes of it. usage: groups [PORT] */
#include <inttypes.h>
#include <scree/client.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* [results] */
static void need(scree_result result, const char* what) {
  if (result >= SCREE_OK) return; /* SCREE_NOTHING is no error */
  fprintf(stderr, "%s: %s\n", what, scree_error());
  exit(EXIT_FAILURE);
}
/* [results] */

/* [client] */
static scree_client* connect_to(uint32_t port) {
  scree_options options;
  scree_client* client = NULL;
  need(scree_options_init(&options, sizeof options), "options");
  options.port = port;
  options.flags |= SCREE_STONES | SCREE_ONCE;
  options.radius_m = 64;
  need(scree_client_create(&options, &client), "client");
  return client;
}
/* [client] */

/* [events] */
static int stones = 0;
static void take_events(scree_client* client, uint32_t wait_ms) {
  scree_event event = {.size = sizeof event};
  need(scree_client_poll(client, wait_ms), "poll");
  while (scree_client_next(client, &event) == SCREE_OK) {
    if (event.kind == SCREE_EVENT_STONE) ++stones;
    if (event.kind != SCREE_EVENT_LOST) continue;
    fprintf(stderr, "lost: %s\n", event.text);
    exit(EXIT_FAILURE);
  }
}
/* [events] */

/* [world] */
static scree_status wait_until_loaded(scree_client* client) {
  scree_status status = {.size = sizeof status};
  do {
    take_events(client, 50);
    need(scree_client_status(client, &status), "status");
  } while (!status.loaded);
  return status;
}
/* [world] */

/* [questions] */
static scree_hit ground_below(scree_client* client, const float eye_m[3]) {
  scree_hit hit = {.size = sizeof hit};
  const float from[3] = {eye_m[0], eye_m[1] + 50, eye_m[2]}, down[3] = {0, -1, 0};
  if (scree_client_cast(client, from, down, 200, 0, SCREE_MASK_TERRAIN, &hit) != SCREE_OK) {
    fprintf(stderr, "there is no ground\n");
    exit(EXIT_FAILURE);
  }
  float above = 0;
  const float place[3] = {hit.place_m[0], hit.place_m[1] + 0.5F, hit.place_m[2]};
  need(scree_client_distances(client, place, 1, &above), "distance");
  printf("half a metre above the ground it is %.2f m away\n", above);
  return hit;
}
/* [questions] */

/* [requests] */
static void replied(void* user, const scree_event* reply) {
  *(int*)user = 1;
  printf("request %u: %s\n", reply->request, *reply->text ? reply->text : "done");
}
static void strike(scree_client* client, const float at_m[3]) {
  int answered = 0;
  scree_request request;
  need(scree_request_init(&request, sizeof request, SCREE_CARVE), "request");
  request.shape.radius_m = 1.5F;
  memcpy(request.shape.a_m, at_m, sizeof request.shape.a_m);
  memcpy(request.place_m, at_m, sizeof request.place_m);
  need(scree_find_pattern("radial", &request.pattern), "pattern");
  need(scree_client_request(client, &request, replied, &answered, NULL), "request");
  while (!answered) take_events(client, 50);
}
/* [requests] */

/* [meshes] */
static void count_triangles(scree_client* client, const float eye_m[3]) {
  scree_mesher_options options;
  scree_mesher* mesher = NULL;
  size_t triangles = 0;
  uint32_t complete = 0;
  need(scree_mesher_options_init(&options, sizeof options), "options");
  options.radius_m = 32;
  need(scree_mesher_create(client, &options, &mesher), "mesher");
  while (!complete) {
    scree_mesh mesh = {.size = sizeof mesh};
    take_events(client, 10);
    if (scree_mesher_update(mesher, eye_m) == SCREE_OK)
      while (scree_mesher_next(mesher, &mesh) == SCREE_OK) triangles += mesh.index_count / 3;
    need(scree_mesher_complete(mesher, &complete), "complete");
  }
  printf("%zu triangles\n", triangles);
  scree_mesher_destroy(mesher);
}
/* [meshes] */

int main(int argc, char** argv) {
  scree_client* const client = connect_to(argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0);
  scree_status status = wait_until_loaded(client);
  const scree_hit ground = ground_below(client, status.eye_m);
  count_triangles(client, status.eye_m);
  strike(client, ground.place_m);
  const uint64_t asked_at = status.server_tick;
  for (int i = 0; i < 600; ++i) { /* until the server's status of a world at rest has come */
    take_events(client, 100);
    need(scree_client_status(client, &status), "status");
    if (status.server_tick > asked_at + 60 && status.pieces == 0 && status.field_hash == status.server_hash) break;
  }
  printf("%d stones lie there, hash %016" PRIx64 "\n", stones, status.field_hash);
  scree_client_destroy(client);
  return EXIT_SUCCESS;
}
