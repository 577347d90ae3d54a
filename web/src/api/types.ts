// Short names for the types of the server's messages, which are generated into schema.d.ts.
import type { components } from './schema';

type Schemas = components['schemas'];

export type Ask = Schemas['Query']['ask'];
export type AskOf<K extends Kind> = Extract<Ask, { kind: K }>;
export type Kind = Ask['kind'];
export type Answer = Schemas['AnswerPost']['answer'];
export type AnswerOf<K extends Answer['kind']> = Extract<Answer, { kind: K }>;
export type AssignedRun = Schemas['AssignedRun'];
export type Assignment = Schemas['Assignment'];
export type DemoSegment = Schemas['DemoSegment'];
export type Box = Schemas['Box'];
export type Costs = Schemas['Costs'];
export type Curves = Schemas['Curves'];
export type Forecast = Schemas['Forecast'];
export type ForecastRange = Schemas['ForecastRange'];
export type LeaseRequest = Schemas['Lease'];
export type Me = Schemas['Me'];
export type PlayMoves = Schemas['PlayMoves'];
export type PlayStage = Schemas['PlayStage'];
export type PlayStates = Schemas['PlayStates'];
export type PlayTake = Schemas['PlayTake'];
export type Price = Schemas['Price'];
export type Query = Schemas['Query'];
export type Receipt = Schemas['Receipt'];
export type Run = Schemas['Run'];
export type Segment = Schemas['Segment'];
export type AuditPage = Schemas['AuditPage'];
export type AuditAction = AuditPage['rows'][number]['action'];
export type AtWork = Schemas['AtWork'];
export type LedgerEntry = Schemas['LedgerEntry'];
export type PagedLedger = Schemas['LedgerPage'];
export type PastAssignment = Schemas['PastAssignment'];
export type QueryHistory = Schemas['QueryHistory'];
export type PagedQueries = Schemas['QueryPage'];
export type QueryRow = Schemas['QueryRow'];
export type RunList = Schemas['RunList'];
export type Stuck = Schemas['Stuck'];
export type StuckQuery = Schemas['StuckQuery'];
export type Verdict = Schemas['InspectAnswer']['verdict'];
export type Vocabulary = Schemas['Vocabulary'];
export type Role = Schemas['User']['role'];
export type User = Schemas['User'];
export type Comment = Schemas['Comment'];
export type Returned = Schemas['Returned'];
export type Agreement = Schemas['Agreement'];
export type ReviewPage = Schemas['ReviewPage'];
export type ReviewRow = Schemas['ReviewRow'];
export type Numbers = Schemas['Numbers'];
export type Scope = NonNullable<Token['scopes']>[number];
export type Token = Schemas['Token'];
export type Session = Schemas['Session'];
export type Gold = Schemas['Gold'];
export type Outlook = Schemas['Outlook'];
export type RunOutlook = Schemas['RunOutlook'];
export type DemoForm = RunOutlook['demonstrations'][number];
export type Practice = Schemas['Practice'];
export type Feedback = Schemas['Feedback'];
export type Json = Schemas['JsonValue'];

/** The kinds of query about a trajectory of the learner: every kind except the demonstration. */
export const ANSWERABLE = [
  'inspect_full',
  'label_hi',
  'inspect_lo',
  'label_lo',
  'label_full',
] as const satisfies readonly Kind[];
export type AnswerableKind = (typeof ANSWERABLE)[number];
export type Answerable = AskOf<AnswerableKind>;

/** All kinds, in the order of the paper's algorithms. */
export const KINDS = ['hier_demo', ...ANSWERABLE] as const satisfies readonly Kind[];
