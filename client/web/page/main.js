// The page: joins what its modules do. One animation frame passes the hands' input to the client, lets it draw, and serves
// its socket; panels follow its state a few times a second.
import { AddressBar, at_port, format, parse } from './address.js';
import { Client, fetch_wasm } from './client.js';
import { Cross } from './cross.js';
import { $, write } from './dom.js';
import { figures_page, show_brief } from './figures.js';
import { Game } from './game.js';
import { Gate, terrain_part } from './gate.js';
import { help_page } from './help.js';
import { listen } from './keyboard.js';
import { choices_of, keep, load, restore, token } from './kept.js';
import { buffer_size, layout_of } from './layout.js';
import { Mouse } from './mouse.js';
import { Notices } from './notices.js';
import { step_pad } from './pad.js';
import { Panel } from './panel.js';
import { draw_names, people_page, Talk } from './people.js';
import { save_picture } from './picture.js';
import { is_withheld, token_to_send } from './secrets.js';
import { Signs } from './signs.js';
import { Socket, session_url } from './socket.js';
import { Timeline } from './timeline.js';
import { tool_page, Tools } from './tools.js';
import { Touch } from './touch.js';
import { view_page } from './view_page.js';

/** How often panels follow, and how often choices are kept; and the pace of a page that nobody sees. */
const PANELS_MS = 200, KEEP_MS = 2000, HIDDEN_MS = 1000;

const canvas = $('view');
const gate = new Gate();

const NO_WEBGL = 'This page draws with WebGL 2, which this browser does not have, or does not allow now. A current Firefox, Chrome, Edge or '
  + 'Safari has it; it may be switched off in the settings (hardware acceleration), or the graphics driver may be on a list of bad ones.';

/** What the address wants; the token leaves it at once. */
function wishes_of_address() {
  const wishes = parse(location.hash);
  if (wishes.token || wishes.unfit) token.keep(wishes.token ?? '');
  if (wishes.name !== undefined) keep({ name: wishes.name });
  if (wishes.token || wishes.unfit || wishes.name !== undefined)
    history.replaceState(null, '', location.pathname + location.search + format(wishes));
  return wishes;
}

/** Read before anything is loaded, which may take long or fail. */
const first_wishes = wishes_of_address();

class Page {
  #client;
  #socket;
  #panel;
  #pages;
  #tools;
  #talk;
  #timeline;
  #notices = new Notices();
  #sound = null;
  #sound_comes = null;
  #cross = new Cross();
  #signs = new Signs();
  #game;
  #mouse;
  #touch;
  #address;
  #chosen_view = {};  // what the address says of the drawing, and the panel's choices since
  #catalogue;
  #state = null;
  #wants_picture = false;
  #was_kept = '';
  #kept_ms = 0;
  #panels_ms = 0;
  #names_shown = false;
  #colours = new Map();
  #pad = false;
  #over = false;
  #past;  // the port of this world's replay
  #now;   // and of the world that this is the replay of
  #rewound = false;

  constructor(client) {
    this.#client = client;
    this.#catalogue = client.catalogue();
    this.#socket = new Socket(client, session_url(location));
    restore(client);
    this.#take_wishes(first_wishes);
    this.#introduce();
    this.#make_panels();
    this.#listen();
    this.#game = new Game(client);
    // For scripts of a game (docs/browser.md), for a browser's console, and for tests.
    globalThis.scree = {
      on: (event, listener) => this.#game.on(event, listener), send: (channel, data) => this.#game.send(channel, data),
      state: () => client.state(), camera: (text) => client.set('camera', text), sound: () => this.#sound?.peak() ?? -1,
    };
    dispatchEvent(new Event('scree'));
    requestAnimationFrame((now_ms) => this.#frame(now_ms));
    setInterval(() => { if (document.hidden) this.#step(performance.now()); }, HIDDEN_MS);
  }

  // ---- wishes of the address

  /** Who the person is, and by what right; a connection says so when it begins. */
  #introduce() {
    this.#client.set('token', token_to_send());
    this.#client.set('name', String(load().name ?? ''));
  }

  #take_wishes({ camera, method, quality, view, past, now, unfit }) {
    if (unfit) this.#notices.say('The token in the address is not valid, so it is ignored.');
    const set = (name, value) => value !== undefined && this.#client.set(name, value);
    set('camera', camera);
    if (set('method', method)) this.#chosen_view.method = method;
    if (set('quality', quality)) this.#chosen_view.quality = quality;
    if (view !== undefined && set('view_radius', Number(view))) this.#chosen_view.view = view;
    this.#past = past;
    this.#now = now;
    set('past', past ? 1 : 0);
  }

  /** The fragment for a link to what is seen now. */
  #fragment() {
    const { camera, view } = this.#state;
    const first = this.#catalogue.methods[0].name;
    const method = view.method !== first || this.#chosen_view.method ? view.method : '';
    return format({ camera, method, quality: view.quality_auto ? '' : view.quality, view: this.#chosen_view.view, past: this.#past, now: this.#now });
  }

  /** To the replay of this world, or from it back to the present; the camera stays. */
  #travel() {
    const to = this.#past ?? this.#now;
    if (!to || !this.#state) return;
    const here = location.port || '80';
    const { camera } = this.#state;
    location.assign(at_port(location, to, format({ camera, view: this.#chosen_view.view, ...(this.#past ? { now: here } : { past: here }) })));
  }

  /** Who came here from the present sees time run backwards at first. */
  #rewind(playback) {
    if (!this.#now || !playback || this.#rewound) return;
    this.#rewound = true;
    this.#client.act('replay_end');
    this.#client.speed(-1);
    this.#client.play(true);
  }

  #follow_address() {
    const wishes = wishes_of_address();
    this.#take_wishes(wishes);
    if (!wishes.token && !wishes.unfit && wishes.name === undefined) return;
    if (is_withheld()) return location.reload(); // which asks
    this.#introduce();
    this.#pages.people.name.value = load().name ?? '';
    this.#socket.renew();
  }

  // ---- panels

  #make_panels() {
    const client = this.#client;
    this.#pages = {
      tool: tool_page(client, this.#catalogue),
      view: view_page((wish, value) => this.#set_view(wish, value), this.#catalogue, (action) => this.#act(action)),
      people: people_page(client, this.#catalogue, (name) => this.#rename(name), this.#colours,
        () => this.#act('talk')),
      figures: figures_page(),
      help: help_page(this.#catalogue),
    };
    this.#pages.people.name.value = load().name ?? '';
    this.#panel = new Panel(this.#pages);
    this.#tools = new Tools(client, this.#catalogue);
    this.#talk = new Talk(client, () => canvas.focus({ preventScroll: true }));
    this.#timeline = new Timeline(client, this.#now ? () => this.#travel() : null);
    this.#show_figures(load().figures === true);
    $('retry').addEventListener('click', () => client.reconnect());
  }

  #set_view(wish, value) {
    if (wish === 'view_radius') this.#chosen_view.view = value;
    return this.#client.set(wish, value);
  }

  #rename(name) {
    if (!this.#client.set('name', name)) return this.#notices.say('That name is too long.');
    keep({ name });
    this.#socket.renew();
  }

  // ---- hands

  #listen() {
    const client = this.#client;
    this.#mouse = new Mouse(canvas, client, () => this.#hint());
    this.#touch = new Touch(canvas, client, () => this.#show_all());
    listen(client, (action) => this.#act(action));
    for (const gesture of ['pointerdown', 'keydown']) addEventListener(gesture, () => this.#with_sound(), { once: true, passive: true });
    addEventListener('hashchange', () => this.#follow_address());
    addEventListener('pagehide', () => {
      client.leave();
      this.#socket.step();
    });
    new ResizeObserver(() => this.#resize()).observe(canvas);
    matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener('change', () => this.#resize());
    this.#resize();
  }

  /** Browsers play nothing before a gesture, so nothing of sound is loaded before. */
  #with_sound() {
    this.#sound_comes ??= import('./sound.js').then(({ Sound }) => {
      this.#sound = new Sound(this.#client, (text) => this.#notices.say(text));
      return this.#sound;
    });
    return this.#sound_comes;
  }

  #resize() {
    const { clientWidth, clientHeight } = canvas;
    const { width, height } = buffer_size(clientWidth, clientHeight, devicePixelRatio);
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    this.#client.resize(width, height);
    document.body.dataset.layout = layout_of(clientWidth, clientHeight);
  }

  #hint() {
    const touch = document.body.dataset.touch !== undefined;
    this.#notices.hint(this.#panel.open || this.#pad || touch ? '' : hint_of(this.#state, this.#mouse.taken, this.#now));
  }

  #show_all() { document.body.classList.remove('bare'); }

  /** What keys, buttons and the client ask of the page. */
  #act(action) {
    const pages = { panel: this.#state?.connection.replay ? 'view' : 'tool', persons: 'people', all_figures: 'figures', graphs: 'figures', help: 'help' };
    if (pages[action]) this.#panel.toggle(pages[action]);
    else if (action === 'figures') this.#show_figures(!load().figures);
    else if (action === 'hide') document.body.classList.toggle('bare');
    else if (action === 'free_mouse') this.#mouse.taken ? this.#mouse.free() : this.#mouse.take();
    else if (action === 'picture') this.#wants_picture = true;
    else if (action === 'copy_place') this.#copy_link();
    else if (action === 'talk') this.#talk_to_all();
    else if (action === 'full_screen') this.#full_screen();
    else if (action === 'mute') this.#with_sound().then((sound) => sound.toggle());
    else if (action === 'replay_play' || action === 'present') this.#travel();
  }

  /** In brief, in the corner. */
  #show_figures(on) {
    keep({ figures: on });
    $('readout').hidden = !on;
  }

  #talk_to_all() {
    if (this.#state?.connection.phase === 'lost') return this.#client.reconnect();
    if (!this.#state?.persons.chat) return this.#notices.say('There is no chat here.');
    this.#panel.show(document.body.dataset.layout === 'wide' ? this.#panel.open : null);
    this.#mouse.free();
    this.#talk.open();
  }

  async #copy_link() {
    const link = location.origin + location.pathname + this.#fragment();
    try {
      await navigator.clipboard.writeText(link);
      this.#notices.say('The link to this view is copied.');
    } catch {
      history.replaceState(null, '', link);
      this.#notices.say("The address above is this view's link.");
    }
  }

  async #full_screen() {
    try {
      if (document.fullscreenElement) await document.exitFullscreen();
      else await document.documentElement.requestFullscreen();
    } catch {
      this.#notices.say('This browser cannot show a full screen.');
    }
  }

  // ---- frames

  #frame(now_ms) {
    if (this.#over) return;
    this.#step(now_ms);
    requestAnimationFrame((next_ms) => this.#frame(next_ms));
  }

  #step(now_ms) {
    if (this.#over) return;
    this.#touch.step();
    this.#pad = step_pad(this.#client) || this.#pad;
    if (!this.#client.frame()) return this.#end();
    if (this.#wants_picture) this.#take_picture();
    this.#sound?.step();
    this.#socket.step();
    for (const action of this.#client.asked()) this.#act(action);
    this.#draw_names();
    this.#signs.show(this.#client.signs(), canvas.clientWidth, canvas.clientHeight);
    this.#game.step();
    if (now_ms - this.#panels_ms < PANELS_MS) return;
    this.#panels_ms = now_ms;
    this.#follow(this.#client.state(), now_ms);
  }

  #take_picture() {
    this.#wants_picture = false;
    save_picture(canvas, (text) => this.#notices.say(text));
  }

  #draw_names() {
    const others = (this.#state?.persons.list.length ?? 0) > 1 || this.#state?.playback;
    if (!others && !this.#names_shown) return;
    const names = others ? this.#client.names() : [];
    for (const { session, colour } of names) this.#colours.set(session, colour);
    this.#names_shown = names.length > 0;
    draw_names(names, canvas.clientWidth, canvas.clientHeight);
  }

  #follow(state, now_ms) {
    this.#state = state;
    gate.follow(state);
    this.#hint();
    this.#notices.follow(state);
    this.#cross.follow(state, now_ms);
    this.#chip(state);
    this.#panel.count('people', state.persons.list.length > 1 ? String(state.persons.list.length) : '');
    this.#tools.follow(state);
    this.#talk.follow(state);
    this.#timeline.follow(state);
    this.#rewind(state.playback);
    this.#pages.figures.note(state);
    this.#panel.follow({ ...state, sound: this.#sound?.on ?? load().sound !== false });
    show_brief(state);
    this.#filling(state);
    if (!gate.open) return;
    this.#address ??= new AddressBar(location.hash, (fragment) => history.replaceState(null, '', fragment || location.pathname));
    this.#address.note(this.#fragment(), now_ms);
    this.#keep(state, now_ms);
  }

  #chip({ connection, eye }) {
    $('chip').dataset.phase = connection.phase;
    write($('chip').firstElementChild, eye || (connection.phase === 'connected' ? `${location.host}${connection.replay ? ', a recording' : ''}` : connection.phase));
  }

  #filling(state) {
    const part = terrain_part(state);
    const bar = $('filling');
    bar.hidden = part >= 1 || !gate.open;
    bar.setAttribute('aria-valuenow', String(Math.round(100 * part)));
    bar.firstElementChild.style.width = `${100 * part}%`;
  }

  #keep(state, now_ms) {
    if (now_ms - this.#kept_ms < KEEP_MS) return;
    this.#kept_ms = now_ms;
    const choices = choices_of(state);
    const text = JSON.stringify(choices);
    if (text !== this.#was_kept) keep(choices);
    this.#was_kept = text;
  }

  #end() {
    this.#over = true;
    $('gate').classList.remove('open');
    gate.failed('The picture ended', `${this.#client.error()}.`);
  }
}

/** The one line that helps now. */
function hint_of(state, taken, came_from) {
  if (state?.connection.phase !== 'connected') return '';
  if (state.connection.replay && came_from) return 'J holds or plays, Y turns time round, the arrow keys jump · Backspace: back to the present';
  if (state.connection.replay) return taken ? '' : 'Click, and the mouse looks around · J plays, or holds · H: all keys';
  if (state.mark.number > 0) return state.hint;
  return taken ? 'Click, or press E, to dig where the cross is; hold it to dig on'
    : 'Click, and the mouse looks around, or use the arrow keys · E digs where the cross is · H: all keys';
}

async function begin() {
  try {
    if (is_withheld()) await gate.ask_about_token();
    const wasm = await fetch_wasm((come, part) => gate.loading(come, part));
    gate.starting();
    const client = await Client.load(canvas, wasm);
    const missing = client.begin('#view');
    if (missing === 'webgl') return gate.failed('No WebGL 2', NO_WEBGL);
    if (missing) return gate.failed('The viewer does not start', `${client.error()}.`);
    new Page(client);
  } catch (error) {
    gate.failed('The viewer could not be loaded', error.message);
  }
}

begin();
