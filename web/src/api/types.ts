import type { components } from './schema';

type Schemas = components['schemas'];

export type Ask = Schemas['Query']['ask'];
export type AskOf<K extends Kind> = Extract<Ask, { kind: K }>;
export type Kind = Ask['kind'];
export type Answer = Schemas['AnswerPost']['answer'];
export type AnswerOf<K extends Answer['kind']> = Extract<Answer, { kind: K }>;
export type Assignment = Schemas['Assignment'];
export type Costs = Schemas['Costs'];
export type Curves = Schemas['Curves'];
export type Lease = Schemas['Lease'];
export type Me = Schemas['Me'];
export type Prices = Schemas['Prices'];
export type Query = Schemas['Query'];
export type Receipt = Schemas['Receipt'];
export type Run = Schemas['Run'];
export type Segment = Schemas['Segment'];
export type Verdict = Schemas['InspectAnswer']['verdict'];
export type Vocabulary = Schemas['Vocabulary'];
export type Role = Schemas['User']['role'];
export type User = Schemas['User'];
export type Numbers = Schemas['Numbers'];
export type Token = Schemas['Token'];
export type Session = Schemas['Session'];
export type Gold = Schemas['Gold'];
export type Practice = Schemas['Practice'];
export type Feedback = Schemas['Feedback'];
export type Json = Schemas['JsonValue'];

/** The kinds this page can answer; demonstrations are answered by programs. */
export const ANSWERABLE = [
  'inspect_full',
  'label_hi',
  'inspect_lo',
  'label_lo',
  'label_full',
] as const satisfies readonly Kind[];
export type AnswerableKind = (typeof ANSWERABLE)[number];
export type Answerable = AskOf<AnswerableKind>;

/** The paper's names of the queries. */
export const KIND_NAMES: Record<Kind, string> = {
  hier_demo: 'HierDemo',
  inspect_full: 'Inspect_FULL',
  label_hi: 'Label_HI',
  inspect_lo: 'Inspect_LO',
  label_lo: 'Label_LO',
  label_full: 'Label_FULL',
};
