// What numbers of the protocol are called.
import { Role } from './wire.js';

/** Roles in order of power. */
export const ROLES = [['viewer', Role.VIEWER], ['carver', Role.CARVER], ['builder', Role.BUILDER], ['director', Role.DIRECTOR], ['admin', Role.ADMIN]];

export const name_of_role = (role) => ROLES.find(([, number]) => number === role)?.[0] ?? `role ${role}`;
