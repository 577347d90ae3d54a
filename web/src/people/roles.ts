// The roles, and what each role may do.
import type { Role } from '../api/types';

export const ROLES: readonly { readonly role: Role; readonly may: string }[] = [
  { role: 'annotator', may: 'Answers questions; sees runs and their curves, but no single queries.' },
  { role: 'viewer', may: 'Sees everything except people, and changes nothing.' },
  {
    role: 'learner',
    may: 'A program: creates runs, asks queries in them, uses the answers, and sees everything except people.',
  },
  { role: 'admin', may: 'May do everything, including adding people.' },
];
