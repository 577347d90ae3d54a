import type { Role } from '../api/types';

export const ROLES: readonly { readonly role: Role; readonly may: string }[] = [
  { role: 'annotator', may: 'Answers queries, and sees everything but people.' },
  { role: 'viewer', may: 'Sees everything but people, and changes nothing.' },
  { role: 'learner', may: 'A program: makes runs, asks, uses answers, and sees everything but people.' },
  { role: 'admin', may: 'May do everything, letting others in included.' },
];
