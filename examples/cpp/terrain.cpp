// A viewer of terrain in a hundred lines: libscree_client's flat arrays go straight into buffers of OpenGL. W
// and S go on and back, the mouse looks, a click carves. usage: terrain [HOST [PORT]]
#include <epoxy/gl.h>
#include <scree/client.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <utility>

struct Buffers {
  GLuint array = 0, data[3] = {};
  GLsizei count = 0;
  glm::vec3 origin{0.0F};
};
std::map<std::array<int, 4>, Buffers> meshes;  // by level and node

constexpr const char* vertex_text = R"(#version 330
layout(location = 0) in vec3 place; layout(location = 1) in vec3 normal; uniform vec3 origin; uniform mat4 view; out vec3 n;
void main() { n = normal; gl_Position = view * vec4(place + origin, 1); })";
constexpr const char* fragment_text = R"(#version 330
in vec3 n; out vec4 colour;
void main() { colour = vec4(vec3(0.55, 0.52, 0.45) * (0.35 + 0.65 * max(dot(normalize(n), vec3(0.4, 0.8, 0.4)), 0.0)), 1); })";

GLuint make_program() {
  const GLuint program = glCreateProgram();
  for (const auto& [kind, text] :
       {std::pair(GL_VERTEX_SHADER, vertex_text), {GL_FRAGMENT_SHADER, fragment_text}}) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
  }
  glLinkProgram(program);
  return program;
}

void upload(const scree_mesh& mesh) {
  Buffers& made = meshes[{mesh.level, mesh.node[0], mesh.node[1], mesh.node[2]}];
  if (made.array == 0) glGenVertexArrays(1, &made.array), glGenBuffers(3, made.data);
  made.count = static_cast<GLsizei>(mesh.index_count);
  made.origin = glm::make_vec3(mesh.origin_m);
  glBindVertexArray(made.array);
  for (GLuint i = 0; i < 2; ++i) {
    glBindBuffer(GL_ARRAY_BUFFER, made.data[i]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(12 * mesh.vertex_count),
                 i == 0 ? mesh.positions : mesh.normals, GL_STATIC_DRAW);
    glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(i);
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, made.data[2]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * mesh.index_count), mesh.indices,
               GL_STATIC_DRAW);
}

void carve(scree_client* client, glm::vec3 eye, glm::vec3 look) {
  scree_hit hit{sizeof hit};
  scree_request request;
  if (scree_client_cast(client, &eye.x, &look.x, 200.0F, 0.0F, SCREE_MASK_TERRAIN, &hit) != SCREE_OK) return;
  scree_request_init(&request, sizeof request, SCREE_CARVE);
  request.shape.radius_m = 2.0F;
  for (int i = 0; i < 3; ++i) request.shape.a_m[i] = request.place_m[i] = hit.place_m[i];
  scree_client_request(client, &request, nullptr, nullptr, nullptr);
}

int main(int argc, char** argv) {
  scree_options options;
  scree_client* client = nullptr;
  scree_mesher* mesher = nullptr;
  scree_mesher_options meshing;
  scree_options_init(&options, sizeof options);
  scree_mesher_options_init(&meshing, sizeof meshing);
  if (argc > 1) options.host = argv[1];
  if (argc > 2) options.port = static_cast<uint32_t>(std::atoi(argv[2]));
  if (scree_client_create(&options, &client) != SCREE_OK ||
      scree_mesher_create(client, &meshing, &mesher) != SCREE_OK)
    return std::fprintf(stderr, "%s\n", scree_error()), EXIT_FAILURE;
  glfwInit();
  GLFWwindow* const window = glfwCreateWindow(960, 540, "terrain", nullptr, nullptr);
  if (window == nullptr) return std::fprintf(stderr, "there is no window\n"), EXIT_FAILURE;
  glfwMakeContextCurrent(window);
  const GLuint program = make_program();
  glm::vec3 eye(0.0F);
  for (bool began = false, said = false, pressed = false; glfwWindowShouldClose(window) == GLFW_FALSE;) {
    scree_event event{sizeof event};
    scree_client_poll(client, 0);
    while (scree_client_next(client, &event) == SCREE_OK) {
      if (event.kind == SCREE_EVENT_JOINED) meshes.clear();
      if (event.kind == SCREE_EVENT_LOST) std::fprintf(stderr, "lost: %s\n", event.text);
    }
    scree_status status{sizeof status};
    scree_client_status(client, &status);
    if (!began && status.tick != 0) began = true, eye = glm::make_vec3(status.eye_m);
    double x = 0.0, y = 0.0;
    glfwGetCursorPos(window, &x, &y);
    const float yaw = static_cast<float>(x) / 150.0F,
                pitch = glm::clamp(0.8F - static_cast<float>(y) / 250.0F, -1.5F, 1.5F);
    const glm::vec3 look(std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
    eye += look * 0.3F * static_cast<float>(glfwGetKey(window, GLFW_KEY_W) - glfwGetKey(window, GLFW_KEY_S));
    if (!std::exchange(pressed, glfwGetMouseButton(window, 0) == GLFW_PRESS) && pressed)
      carve(client, eye, look);
    if (began) scree_client_follow(client, &eye.x, 96.0F);
    scree_mesh mesh{sizeof mesh};
    if (scree_mesher_update(mesher, &eye.x) == SCREE_OK)
      while (scree_mesher_next(mesher, &mesh) == SCREE_OK)
        if (mesh.kind == 0) upload(mesh);
    int width = 1, height = 1;
    glfwGetFramebufferSize(window, &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(0.6F, 0.7F, 0.8F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glUseProgram(program);
    const glm::mat4 view =
        glm::perspective(1.1F, static_cast<float>(width) / static_cast<float>(height), 0.1F, 2000.0F) *
        glm::lookAt(eye, eye + look, glm::vec3(0.0F, 1.0F, 0.0F));
    glUniformMatrix4fv(glGetUniformLocation(program, "view"), 1, GL_FALSE, glm::value_ptr(view));
    for (const auto& [key, buffers] : meshes) {
      glUniform3fv(glGetUniformLocation(program, "origin"), 1, glm::value_ptr(buffers.origin));
      glBindVertexArray(buffers.array);
      glDrawElements(GL_TRIANGLES, buffers.count, GL_UNSIGNED_INT, nullptr);
    }
    glfwSwapBuffers(window);
    glfwPollEvents();
    uint32_t complete = 0;
    scree_mesher_complete(mesher, &complete);
    if (!said && status.loaded != 0 && complete != 0)
      said = true, std::puts("all is drawn"), std::fflush(stdout);
  }
  scree_client_destroy(client);
  glfwTerminate();
}
