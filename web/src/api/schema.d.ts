/** Generated from the server's OpenAPI document by `npm run types`. Do not edit. */

export interface paths {
    "/api/v1/runs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Runs
         * @description List runs, newest first unless sorted otherwise.
         */
        get: operations["listRuns"];
        put?: never;
        /**
         * Create Run
         * @description Create a run: one learner's training with one algorithm, domain, seed and cost model.
         */
        post: operations["createRun"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Run
         * @description Return a run with its account.
         */
        get: operations["getRun"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        /**
         * Patch Run
         * @description Rename, pause, resume or finish a run; set its budget or priority. Finishing a run cancels its open queries.
         */
        patch: operations["patchRun"];
        trace?: never;
    };
    "/api/v1/runs/{run}/episodes": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Report Episodes
         * @description Report the results of episodes. Reporting the same result again changes nothing.
         */
        post: operations["reportEpisodes"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/curves": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Curves
         * @description Return success and cumulative cost by episode.
         */
        get: operations["getCurves"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/costs": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Costs
         * @description Return the ledger's sums, by kind of query.
         */
        get: operations["getCosts"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/queries": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Queries
         * @description List a run's queries, newest first.
         */
        get: operations["listQueries"];
        put?: never;
        /**
         * Ask
         * @description Ask the expert: all of the queries or none. A query that was asked before is returned with its answer.
         */
        post: operations["ask"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Query
         * @description Return a query; with `wait`, return as soon as it is answered or cancelled.
         */
        get: operations["getQuery"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/answers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Answers
         * @description Return the queries answered after a cursor, in the order of their answers; with `wait`, wait for the first.
         */
        get: operations["listAnswers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}/use": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Use Answer
         * @description Mark the answer as used. From then on it can no longer be retracted.
         */
        post: operations["useAnswer"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Assignments
         * @description List the caller's live assignments, so that a reloaded page can continue with them.
         */
        get: operations["myAssignments"];
        put?: never;
        /**
         * Lease
         * @description Lease the next query; if there is none, wait for one.
         */
        post: operations["lease"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/leave": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Leave
         * @description Say that a browser tab is closing. What it holds is released, and it gets no new leases.
         */
        post: operations["leave"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/{assignment}/renew": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Renew
         * @description Renew the lease: it lasts its full length from now, up to the server's cap.
         */
        post: operations["renew"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/{assignment}/release": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Release
         * @description Give the query back without an answer. With `skip`, it is not offered to the caller again.
         */
        post: operations["release"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/{assignment}/answer": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Answer
         * @description Answer. The answer is stored, charged and closed in one transaction, and acknowledged when it is on disk.
         */
        post: operations["answer"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/assignments/{assignment}/retract": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Retract
         * @description Take back an answer that the learner has not used. It is refunded, and its query is leased again.
         */
        post: operations["retract"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/query-rows": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Query Rows
         * @description List one page of a run's queries without their trajectories, newest first.
         */
        get: operations["listQueryRows"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/ledger": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Ledger
         * @description List one page of a run's charges and refunds, newest first, with the sums over all pages.
         */
        get: operations["listLedger"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/queries/{query}/history": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get History
         * @description Return all assignments of a query, their answers, and what they cost.
         */
        get: operations["getHistory"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/annotators": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List At Work
         * @description List the annotators at work, in one run or in all: those who asked for a query recently or hold one.
         */
        get: operations["listAtWork"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/export": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Run
         * @description Download a run's curves, ledger or queries as CSV or JSON Lines.
         */
        get: operations["exportRun"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Stream Events
         * @description Stream the events of a run, starting after a cursor.
         */
        get: operations["streamEvents"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Stream Changes
         * @description Stream a message when any run changed, at most once a second.
         */
        get: operations["streamChanges"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/frames": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Put Frames
         * @description Upload pictures of states: all of them or none. Pictures that were uploaded before do not change.
         */
        put: operations["putFrames"];
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/frames/missing": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Missing Frames
         * @description Return the hashes of frames that are not stored yet.
         */
        post: operations["missingFrames"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/frames/{frame}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Frame
         * @description Return a picture. The picture of a hash never changes.
         */
        get: operations["getFrame"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Users
         * @description List all users.
         */
        get: operations["listUsers"];
        put?: never;
        /**
         * Create User
         * @description Create a user: a person or a program that may call the server.
         */
        post: operations["createUser"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users/{user}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get User
         * @description Return a user.
         */
        get: operations["getUser"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        /**
         * Patch User
         * @description Change a user's role, deactivate or reactivate them.
         *
         *     Deactivation takes effect immediately: it ends the user's sessions, tokens, login links and leases. Answers stay.
         */
        patch: operations["patchUser"];
        trace?: never;
    };
    "/api/v1/users/{user}/login-links": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Create Login Link
         * @description Create a one-time login code; the link is `<this server>/login#<code>`.
         */
        post: operations["createLoginLink"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users/{user}/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Tokens
         * @description List a user's API tokens, without their secrets.
         */
        get: operations["listTokens"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/users/{user}/numbers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Numbers
         * @description Return a user's performance: number of answers, speed, accuracy on gold queries.
         */
        get: operations["getNumbers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/numbers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Numbers
         * @description Return the performance of every annotator who ever answered.
         */
        get: operations["listNumbers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Create Token
         * @description Create an API token for the caller; an administrator may create one for any user. It is shown only once.
         */
        post: operations["createToken"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tokens/{token}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Revoke Token
         * @description Revoke one of the caller's tokens; an administrator may revoke any. It takes effect immediately.
         */
        delete: operations["revokeToken"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/session": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Login
         * @description Exchange the one-time code of a login link for a session cookie.
         */
        post: operations["login"];
        /**
         * Logout
         * @description End the browser's session. API tokens stay valid.
         */
        delete: operations["logout"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Me
         * @description Return the caller and the totals of their answers. This call also renews a browser's session.
         */
        get: operations["me"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/numbers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Numbers
         * @description Return the caller's performance: number of answers, speed, accuracy on gold queries.
         */
        get: operations["myNumbers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Tokens
         * @description List the caller's API tokens, without their secrets.
         */
        get: operations["myTokens"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/sessions": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * My Sessions
         * @description List the caller's browser sessions.
         */
        get: operations["mySessions"];
        put?: never;
        post?: never;
        /**
         * Logout Everywhere
         * @description End all of the caller's browser sessions, including this one. API tokens stay valid.
         */
        delete: operations["logoutEverywhere"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/gold": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Gold
         * @description List the run's gold queries, newest first, with how well annotators answered them.
         */
        get: operations["listGold"];
        put?: never;
        /**
         * Add Gold
         * @description Make queries gold: answered queries of this run, or other queries with known answers. All of them or none.
         *
         *     The run's `gold_rate` is the share of each annotator's queries that are gold. They look like the learner's queries.
         *     They are never in the run's ledger, and the learner never sees them.
         */
        post: operations["addGold"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/runs/{run}/gold/{item}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Retire Gold
         * @description Retire a gold query: no annotator gets it any more. Answers to it stay.
         */
        delete: operations["retireGold"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/practice": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Practice
         * @description Return the practice queries in the order to answer them.
         */
        get: operations["getPractice"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/practice/{query}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Mark Practice
         * @description Return which labels of an answer are right, and why.
         */
        post: operations["practice"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/healthz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Healthz
         * @description Return that the process is alive.
         */
        get: operations["healthz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/readyz": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Readyz
         * @description Return that the database answers and has this version's schema.
         */
        get: operations["readyz"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/metrics": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Metrics
         * @description Return counts in Prometheus' text format.
         */
        get: operations["metrics"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /**
         * AnswerPage
         * @description Answers in the order they were given, after a cursor; `cursor` is where to go on.
         */
        AnswerPage: {
            /** Queries */
            queries: components["schemas"]["Query"][];
            /** Cursor */
            cursor: number;
        };
        /**
         * AnswerPost
         * @description An answer. Sending it again (same assignment, same content) returns the same receipt and costs nothing.
         */
        AnswerPost: {
            /** Token */
            token: string;
            /** Answer */
            answer: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /** @description Lease the next query in the same call; null for none. */
            next?: components["schemas"]["Lease"] | null;
        };
        /**
         * AskHierDemo
         * @description HierDemo(s): carry out the task from state s and return the hierarchical trajectory, or a flat learner's.
         */
        AskHierDemoInput: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion?: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "hier_demo";
            /** @description s, where the demonstration starts. */
            state: components["schemas"]["JsonValue"];
            /**
             * Flat
             * @description Only actions are wanted: one segment without a subgoal.
             * @default false
             */
            flat: boolean;
            /**
             * Max Segments
             * @description H_HI: a demonstration has at most so many segments.
             */
            max_segments: number;
            /**
             * Max Actions
             * @description H_FULL: and at most so many actions in all.
             */
            max_actions: number;
        };
        /**
         * AskHierDemo
         * @description HierDemo(s): carry out the task from state s and return the hierarchical trajectory, or a flat learner's.
         */
        AskHierDemo: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "hier_demo";
            /** @description s, where the demonstration starts. */
            state: components["schemas"]["JsonValue"];
            /**
             * Flat
             * @description Only actions are wanted: one segment without a subgoal.
             * @default false
             */
            flat: boolean;
            /**
             * Max Segments
             * @description H_HI: a demonstration has at most so many segments.
             */
            max_segments: number;
            /**
             * Max Actions
             * @description H_FULL: and at most so many actions in all.
             */
            max_actions: number;
        };
        /**
         * AskInspectFull
         * @description Inspect_FULL(tau_FULL): was the overall goal accomplished?
         */
        AskInspectFullInput: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion?: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full";
            /** Segments */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskInspectFull
         * @description Inspect_FULL(tau_FULL): was the overall goal accomplished?
         */
        AskInspectFull: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full";
            /** Segments */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskInspectLo
         * @description Inspect_LO(tau; g): did this one segment accomplish its subgoal?
         */
        AskInspectLoInput: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion?: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_lo";
            /** Segments */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskInspectLo
         * @description Inspect_LO(tau; g): did this one segment accomplish its subgoal?
         */
        AskInspectLo: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_lo";
            /** Segments */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskLabelFull
         * @description Label_FULL(tau_FULL): a good action at each state of the full trajectory.
         */
        AskLabelFullInput: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion?: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /** Segments */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskLabelFull
         * @description Label_FULL(tau_FULL): a good action at each state of the full trajectory.
         */
        AskLabelFull: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /** Segments */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskLabelHi
         * @description Label_HI(tau_HI): a good subgoal at the first state of each segment.
         */
        AskLabelHiInput: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion?: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /** Segments */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskLabelHi
         * @description Label_HI(tau_HI): a good subgoal at the first state of each segment.
         */
        AskLabelHi: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /** Segments */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskLabelLo
         * @description Label_LO(tau; g): a good action at each state of this one segment, and where it should have ended.
         */
        AskLabelLoInput: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context?: components["schemas"]["SegmentInput"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion?: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /** Segments */
            segments: components["schemas"]["SegmentInput"][];
        };
        /**
         * AskLabelLo
         * @description Label_LO(tau; g): a good action at each state of this one segment, and where it should have ended.
         */
        AskLabelLo: {
            /**
             * Episode
             * @description Which episode of the run asks.
             */
            episode: number;
            /**
             * Ordinal
             * @description Which query of that episode this is, from 0.
             */
            ordinal: number;
            /**
             * Question
             * @description The question in words, for a person.
             */
            question: string;
            /** @description The environment instance, in the domain's JSON view. */
            instance: components["schemas"]["JsonValue"];
            /**
             * Context
             * @description Segments that came before, shown but not asked about.
             */
            context: components["schemas"]["Segment"][];
            /**
             * Suggestion
             * @description The learner's own choice, as an answer to this query; what it did, not what is right.
             */
            suggestion: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /** Segments */
            segments: components["schemas"]["Segment"][];
        };
        /**
         * AskList
         * @description One or more queries of one run. Asking again with the same (episode, ordinal) and content changes nothing.
         */
        AskList: {
            /** Queries */
            queries: (components["schemas"]["AskHierDemoInput"] | components["schemas"]["AskInspectFullInput"] | components["schemas"]["AskLabelHiInput"] | components["schemas"]["AskInspectLoInput"] | components["schemas"]["AskLabelLoInput"] | components["schemas"]["AskLabelFullInput"])[];
            /**
             * Priority
             * @description Higher is handed out first.
             * @default 0
             */
            priority: number;
        };
        /**
         * Asked
         * @description The reply to `POST /runs/{id}/queries`: the queries in the order asked, old ones with their answers.
         */
        Asked: {
            /** Queries */
            queries: components["schemas"]["Query"][];
        };
        /**
         * Assignment
         * @description One query handed to one annotator under a lease. Only `token` and an unexpired lease can answer it.
         */
        Assignment: {
            /** Id */
            id: number;
            /** Token */
            token: string;
            query: components["schemas"]["Query"];
            run: components["schemas"]["Run"];
            /** @description What the answer will cost. */
            price: components["schemas"]["Price"];
            /** Leased At */
            leased_at: number;
            /** Expires At */
            expires_at: number;
            /** Lease Seconds */
            lease_seconds: number;
        };
        /**
         * AssignmentList
         * @description The caller's live assignments, oldest first: what a reloaded page goes on with.
         */
        AssignmentList: {
            /** Assignments */
            assignments: components["schemas"]["Assignment"][];
        };
        /**
         * AtWork
         * @description An annotator who asked for work of late or holds a query.
         */
        AtWork: {
            /** Annotator */
            annotator: string;
            /**
             * Run
             * @description The run asked for; null for any.
             */
            run: string | null;
            /**
             * Kinds
             * @description The kinds asked for; null for any.
             */
            kinds: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full")[] | null;
            /** Seen At */
            seen_at: number;
            /** Holds */
            holds: components["schemas"]["Holding"][];
        };
        /**
         * AtWorkList
         * @description Who is at work, the one seen last first.
         */
        AtWorkList: {
            /** Annotators */
            annotators: components["schemas"]["AtWork"][];
        };
        /**
         * Change
         * @description Something changed in some run, as sent by server-sent events.
         */
        Change: {
            /**
             * Newest
             * @description The newest event of any run.
             */
            newest: number;
        };
        /**
         * CostOfKind
         * @description The ledger's sum for one kind of query.
         */
        CostOfKind: {
            /** Queries */
            queries: number;
            /** Units */
            units: number;
            /** Lo Units */
            lo_units: number;
            /** Seconds */
            seconds: number;
            /** Active Seconds */
            active_seconds: number;
        };
        /**
         * Costs
         * @description The ledger of a run.
         */
        Costs: {
            /** Total */
            total: number;
            /** Lo Total */
            lo_total: number;
            /** Seconds */
            seconds: number;
            /** Active Seconds */
            active_seconds: number;
            /** By Kind */
            by_kind: {
                [key: string]: components["schemas"]["CostOfKind"];
            };
            /** Reserved */
            reserved: number;
            /** Budget */
            budget: number | null;
            /**
             * First At
             * @description By success level: "0.8", "0.9", "0.95", "0.99".
             */
            first_at: {
                [key: string]: components["schemas"]["Milestone"] | null;
            };
        };
        /**
         * Curves
         * @description Columns of equal length, a row per reported episode; sums are cumulative up to and with that episode.
         */
        Curves: {
            /** Episode */
            episode: number[];
            /**
             * Success Rate
             * @description Over the trailing 100 test episodes (fewer at the start).
             */
            success_rate: (number | null)[];
            /** Test Success */
            test_success: (boolean | null)[];
            /** Cost */
            cost: number[];
            /**
             * Lo Cost
             * @description Units spent on LO labels: actions and terminations.
             */
            lo_cost: number[];
            /**
             * Seconds
             * @description Annotators' seconds, from lease to answer.
             */
            seconds: number[];
            /**
             * Active Seconds
             * @description Annotators' own time, without idle time.
             */
            active_seconds: number[];
            /** Cost By Kind */
            cost_by_kind: {
                [key: string]: number[];
            };
            /**
             * Hi Labels
             * @description Size of D_HI.
             */
            hi_labels: number[];
            /**
             * Lo Samples
             * @description LO-level steps taken in training rollouts.
             */
            lo_samples: number[];
            /**
             * Learner Seconds
             * @description The learner's wall time.
             */
            learner_seconds: number[];
        };
        /**
         * DemoSegment
         * @description One segment of a demonstration; its states follow from the actions.
         */
        DemoSegment: {
            /**
             * Subgoal
             * @description The subgoal carried out; null in a flat demonstration.
             */
            subgoal: string | null;
            /** Actions */
            actions: string[];
        };
        /**
         * EpisodeList
         * @description Results to report, in episode order.
         */
        EpisodeList: {
            /** Episodes */
            episodes: components["schemas"]["EpisodeResult"][];
        };
        /**
         * EpisodeResult
         * @description What one episode brought. Reporting it again, the seconds aside with the same content, changes nothing.
         */
        EpisodeResult: {
            /** Episode */
            episode: number;
            /**
             * Warm Start
             * @description Whether this was a demonstration rather than a rollout.
             */
            warm_start: boolean;
            /**
             * Train Success
             * @description Did the training rollout succeed? Null for a demonstration.
             */
            train_success: boolean | null;
            /**
             * Test Success
             * @description Did the test rollout on an unseen instance succeed?
             */
            test_success: boolean | null;
            /** Train Steps */
            train_steps: number;
            /** Test Steps */
            test_steps: number;
            /**
             * Hi Labels
             * @description Size of D_HI after the episode.
             */
            hi_labels: number;
            /**
             * Lo Labels
             * @description Size of all D_g (flat: of D) after the episode.
             */
            lo_labels: number;
            /**
             * Seconds
             * @description The learner's wall time for the episode.
             */
            seconds: number;
        };
        /**
         * Event
         * @description One change of a run, as sent by server-sent events; `id` is the cursor to go on from.
         */
        Event: {
            /** Id */
            id: number;
            /** Run */
            run: string;
            /**
             * Event
             * @enum {string}
             */
            event: "asked" | "answered" | "retracted" | "used" | "cancelled" | "episode" | "run";
            /** At */
            at: number;
            /** Data */
            data: {
                [key: string]: components["schemas"]["JsonValue"];
            };
        };
        /**
         * Feedback
         * @description How good an answer was, label by label.
         */
        Feedback: {
            /** Marks */
            marks: components["schemas"]["Mark"][];
            /**
             * Reasons
             * @description Why, for each label.
             */
            reasons: string[];
            /**
             * Is Right
             * @description Whether all of them are right.
             */
            is_right: boolean;
        };
        /**
         * Frame
         * @description A PNG and the hash that it goes by.
         */
        Frame: {
            /**
             * Hash
             * @description The SHA-256 of a PNG, in hexadecimal.
             */
            hash: string;
            /**
             * Png
             * @description The file in base64.
             */
            png: string;
        };
        /**
         * FrameHashes
         * @description Frames by their hashes.
         */
        FrameHashes: {
            /** Hashes */
            hashes: string[];
        };
        /**
         * FrameUpload
         * @description Frames to keep. Uploading one again changes nothing.
         */
        FrameUpload: {
            /** Frames */
            frames: components["schemas"]["Frame"][];
        };
        /**
         * Gold
         * @description A gold query, and what annotators made of it.
         */
        Gold: {
            /** Id */
            id: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /** Question */
            question: string;
            /** Known */
            known: components["schemas"]["KnownVerdict"] | components["schemas"]["KnownSubgoals"] | components["schemas"]["KnownSegment"] | components["schemas"]["KnownActions"];
            /**
             * Query
             * @description The query it was marked from.
             */
            query: number | null;
            /**
             * Author
             * @description Who answered that; it is never put to them.
             */
            author: string | null;
            /** Answers */
            answers: number;
            /**
             * Agreement
             * @description The share of right labels over all annotators.
             */
            agreement: number | null;
            /** Created At */
            created_at: number;
        };
        /**
         * GoldList
         * @description The gold queries of a run, newest first.
         */
        GoldList: {
            /** Gold */
            gold: components["schemas"]["Gold"][];
        };
        /**
         * GoldPost
         * @description Queries to be gold in a run. What is gold already stays as it is.
         */
        GoldPost: {
            /**
             * Answered
             * @description Queries of this run; right is just what was answered.
             */
            answered?: number[];
            /** Known */
            known?: components["schemas"]["KnownAsk"][];
        };
        /**
         * Health
         * @description Alive, or ready to work.
         */
        Health: {
            /**
             * Status
             * @constant
             */
            status: "ok";
            /** Version */
            version: string;
        };
        /**
         * HierDemoAnswer
         * @description The expert's own trajectory: hierarchical, each segment ending where its subgoal is reached; or one flat one.
         */
        HierDemoAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "hier_demo";
            /** Segments */
            segments: components["schemas"]["DemoSegment"][];
        };
        /**
         * Holding
         * @description A query somebody holds right now.
         */
        Holding: {
            /** Query */
            query: number;
            /** Run */
            run: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /** Episode */
            episode: number;
            /** Leased At */
            leased_at: number;
        };
        /**
         * InspectAnswer
         * @description Pass or Fail, for Inspect_FULL and Inspect_LO.
         */
        InspectAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full" | "inspect_lo";
            /**
             * Verdict
             * @enum {string}
             */
            verdict: "pass" | "fail";
        };
        JsonValue: unknown;
        /**
         * KnownActions
         * @description The actions that are right, for each state of the full trajectory.
         */
        KnownActions: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /** Actions */
            actions: string[][];
        };
        /**
         * KnownAsk
         * @description A query and what is right: for each label all that is, where several choices are as good.
         */
        KnownAsk: {
            /** Ask */
            ask: components["schemas"]["AskHierDemoInput"] | components["schemas"]["AskInspectFullInput"] | components["schemas"]["AskLabelHiInput"] | components["schemas"]["AskInspectLoInput"] | components["schemas"]["AskLabelLoInput"] | components["schemas"]["AskLabelFullInput"];
            /** Known */
            known: components["schemas"]["KnownVerdict"] | components["schemas"]["KnownSubgoals"] | components["schemas"]["KnownSegment"] | components["schemas"]["KnownActions"];
        };
        /**
         * KnownSegment
         * @description The actions that are right, for each state before the segment should end.
         */
        KnownSegment: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /** Actions */
            actions: string[][];
            /**
             * End
             * @description The state it should end in, from 0; null if in none of them.
             */
            end: number | null;
        };
        /**
         * KnownSubgoals
         * @description The subgoals that are right, for each segment.
         */
        KnownSubgoals: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /** Subgoals */
            subgoals: string[][];
        };
        /**
         * KnownVerdict
         * @description What an inspection should say.
         */
        KnownVerdict: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "inspect_full" | "inspect_lo";
            /**
             * Verdict
             * @enum {string}
             */
            verdict: "pass" | "fail";
        };
        /**
         * LabelFullAnswer
         * @description a*_1 .. a*_H over the joined segments.
         */
        LabelFullAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_full";
            /** Actions */
            actions: string[];
        };
        /**
         * LabelHiAnswer
         * @description g*_1 .. g*_n: a good subgoal for each segment of the query.
         */
        LabelHiAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_hi";
            /** Subgoals */
            subgoals: string[];
        };
        /**
         * LabelLoAnswer
         * @description a*_1 .. a*_H and omega*_1 .. omega*_{H+1} of one segment with H actions.
         *
         *     Labels count up to the first true termination. An action may be null only there and after it: the segment should
         *     have ended, so no action toward the subgoal is good.
         */
        LabelLoAnswer: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            kind: "label_lo";
            /** Actions */
            actions: (string | null)[];
            /** Terminations */
            terminations: boolean[];
        };
        /**
         * Lease
         * @description What an annotator is willing to take.
         */
        Lease: {
            /**
             * Wait
             * @description Wait so long for a query, seconds.
             * @default 0
             */
            wait: number;
            /**
             * Kinds
             * @description Only these kinds; null for all.
             */
            kinds?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full")[] | null;
            /**
             * Run
             * @description Only this run; null for all.
             */
            run?: string | null;
            /**
             * Defer
             * @description Leave a query this many seconds to other annotators who are at work and take its kind. A bot that helps people sets it; nobody else need.
             * @default 0
             */
            defer: number;
            /**
             * Ahead
             * @description To be answered after what the annotator holds already: only while enough queries are left for everybody else at work.
             * @default false
             */
            ahead: boolean;
            /**
             * Tab
             * @description The page that asks, so that it can give back all it holds.
             */
            tab?: string | null;
        };
        /**
         * Leave
         * @description A page is going: give back all it holds, and lease nothing more to it.
         */
        Leave: {
            /**
             * Tab
             * @description A page's own name for itself, of its making.
             */
            tab: string;
            /**
             * Keep
             * @description Assignments whose answers are still being sent.
             */
            keep: number[];
        };
        /**
         * LedgerEntry
         * @description One line of the ledger: a charge, or a refund with its amounts below zero.
         */
        LedgerEntry: {
            /** Id */
            id: number;
            /** At */
            at: number;
            /**
             * Entry
             * @enum {string}
             */
            entry: "charge" | "refund";
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /** Query */
            query: number;
            /** Episode */
            episode: number;
            /** Ordinal */
            ordinal: number;
            /** Annotator */
            annotator: string;
            /** Units */
            units: number;
            /** Lo Units */
            lo_units: number;
            /** Seconds */
            seconds: number;
            /**
             * Balance
             * @description What the run had spent after this line.
             */
            balance: number;
        };
        /**
         * LedgerPage
         * @description A page of a run's ledger, newest first, and the sums of all its pages.
         */
        LedgerPage: {
            /** Entries */
            entries: components["schemas"]["LedgerEntry"][];
            /**
             * Total
             * @description How many lines there are on all pages.
             */
            total: number;
            /**
             * Newest
             * @description The newest of them on any page.
             */
            newest: number | null;
            /**
             * Oldest
             * @description The oldest of them on any page.
             */
            oldest: number | null;
            /** Units */
            units: number;
            /** Lo Units */
            lo_units: number;
            /** Seconds */
            seconds: number;
            /**
             * Spent
             * @description What the run's account says; without a filter, `units` is the same.
             */
            spent: number;
        };
        /**
         * Login
         * @description A one-time code out of a login link.
         */
        Login: {
            /** Code */
            code: string;
        };
        /**
         * LoginLink
         * @description A one-time login link's code, shown once.
         */
        LoginLink: {
            /** Code */
            code: string;
            /** Expires At */
            expires_at: number;
        };
        /**
         * LoginLinkCreate
         * @description How long a new login link is to be good.
         */
        LoginLinkCreate: {
            /**
             * Seconds
             * @description Null for the server's usual time.
             */
            seconds?: number | null;
        };
        /**
         * Mark
         * @description One label of an answer, beside what is right there.
         */
        Mark: {
            /**
             * Place
             * @description Which label, from 0; of a segment's actions and its end, which state.
             */
            place: number;
            /**
             * Given
             * @description "(done)" and "(not done)" are the two labels of a segment's end.
             */
            given: string | null;
            /**
             * Right
             * @description All that is right there.
             */
            right: string[];
            /** Is Right */
            is_right: boolean;
        };
        /**
         * Me
         * @description Who is calling.
         */
        Me: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /**
             * Role
             * @enum {string}
             */
            role: "admin" | "learner" | "annotator" | "viewer";
            /**
             * Answers
             * @description Answers that counted.
             */
            answers: number;
            /** Answers Today */
            answers_today: number;
            /** Median Seconds */
            median_seconds: number | null;
            /**
             * Units
             * @description What these answers cost, in all runs.
             */
            units: number;
        };
        /**
         * Milestone
         * @description When the success rate over 100 test episodes first reached a level.
         */
        Milestone: {
            /** Episode */
            episode: number;
            /** Cost */
            cost: number;
        };
        /**
         * NewToken
         * @description A token, shown once; the server keeps only its hash.
         */
        NewToken: {
            /** Id */
            id: number;
            /** Token */
            token: string;
        };
        /**
         * Numbers
         * @description An annotator's own numbers, over all runs. Days are those of UTC.
         */
        Numbers: {
            /** User */
            user: number;
            /** Name */
            name: string;
            total: components["schemas"]["Tally"];
            today: components["schemas"]["Tally"];
            /** @description Today and the six days before. */
            week: components["schemas"]["Tally"];
            /** Gold */
            gold: number;
            /** Agreement */
            agreement: number | null;
            /**
             * By Kind
             * @description The kinds they have answered.
             */
            by_kind: components["schemas"]["NumbersOfKind"][];
        };
        /**
         * NumbersList
         * @description Everybody's numbers who ever answered, by name.
         */
        NumbersList: {
            /** Annotators */
            annotators: components["schemas"]["Numbers"][];
        };
        /**
         * NumbersOfKind
         * @description An annotator's answers to one kind of query.
         */
        NumbersOfKind: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            total: components["schemas"]["Tally"];
            /** Median Seconds */
            median_seconds: number;
            /**
             * Gold
             * @description How many of them were to gold queries.
             */
            gold: number;
            /**
             * Gold Right
             * @description How many of those were right in every label.
             */
            gold_right: number;
            /**
             * Agreement
             * @description The share of right labels among those of gold queries.
             */
            agreement: number | null;
        };
        /**
         * PastAnswer
         * @description An answer as it was given; never changed.
         */
        PastAnswer: {
            /** Id */
            id: number;
            /** Content */
            content: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
            /** At */
            at: number;
            /**
             * Units
             * @description What it was charged; 0 if it came too late.
             */
            units: number;
            /** Seconds */
            seconds: number;
            /**
             * Fate
             * @enum {string}
             */
            fate: "counts" | "retracted" | "late";
        };
        /**
         * PastAssignment
         * @description One time a query was handed out, and how that ended.
         */
        PastAssignment: {
            /** Id */
            id: number;
            /** Annotator */
            annotator: string;
            /**
             * State
             * @enum {string}
             */
            state: "live" | "answered" | "skipped" | "released" | "expired" | "cancelled";
            /**
             * Reason
             * @description What was said when it was skipped or given back.
             */
            reason: string | null;
            /** Leased At */
            leased_at: number;
            /** Expires At */
            expires_at: number;
            /** Ended At */
            ended_at: number | null;
            answer: components["schemas"]["PastAnswer"] | null;
        };
        /**
         * Practice
         * @description Queries whose answers are known, in the order to meet them. Practicing stores nothing and costs nothing.
         */
        Practice: {
            vocabulary: components["schemas"]["Vocabulary"];
            /** Queries */
            queries: components["schemas"]["PracticeQuery"][];
        };
        /**
         * PracticeAnswer
         * @description An answer given for practice.
         */
        PracticeAnswer: {
            /** Answer */
            answer: components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"];
        };
        /**
         * PracticeQuery
         * @description A query to practice on.
         */
        PracticeQuery: {
            /** Id */
            id: number;
            /** Ask */
            ask: components["schemas"]["AskHierDemo"] | components["schemas"]["AskInspectFull"] | components["schemas"]["AskLabelHi"] | components["schemas"]["AskInspectLo"] | components["schemas"]["AskLabelLo"] | components["schemas"]["AskLabelFull"];
        };
        /**
         * Price
         * @description The price of an answer: `fixed` + `per_action` x its actions + `per_segment` x its segments, in units.
         *
         *     Only the price of a demonstration depends on the answer; every other kind has a `fixed` price.
         */
        Price: {
            /** Fixed */
            fixed: number;
            /** Per Action */
            per_action: number;
            /** Per Segment */
            per_segment: number;
        };
        /**
         * Prices
         * @description What one label costs, in units, to six decimals. The paper: Label = length of what is labeled, Inspect = 1.
         */
        PricesInput: {
            /**
             * Subgoal
             * @description One HI label: a subgoal at a state.
             * @default 1
             */
            subgoal: number;
            /**
             * Action
             * @description One LO label: an action at a state.
             * @default 1
             */
            action: number;
            /**
             * Termination
             * @description The termination label of a segment's last state.
             * @default 1
             */
            termination: number;
            /**
             * Inspect Full
             * @default 1
             */
            inspect_full: number;
            /**
             * Inspect Lo
             * @default 1
             */
            inspect_lo: number;
        };
        /**
         * Prices
         * @description What one label costs, in units, to six decimals. The paper: Label = length of what is labeled, Inspect = 1.
         */
        Prices: {
            /**
             * Subgoal
             * @description One HI label: a subgoal at a state.
             * @default 1
             */
            subgoal: number;
            /**
             * Action
             * @description One LO label: an action at a state.
             * @default 1
             */
            action: number;
            /**
             * Termination
             * @description The termination label of a segment's last state.
             * @default 1
             */
            termination: number;
            /**
             * Inspect Full
             * @default 1
             */
            inspect_full: number;
            /**
             * Inspect Lo
             * @default 1
             */
            inspect_lo: number;
        };
        /**
         * Problem
         * @description RFC 9457: what was wrong and what to do about it.
         */
        Problem: {
            /**
             * Type
             * @description A stable name of the problem: `/problems/<name>`.
             */
            type: string;
            /** Title */
            title: string;
            /** Status */
            status: number;
            /** Detail */
            detail: string;
            /** Instance */
            instance?: string | null;
            /**
             * Errors
             * @description For 422: each field at fault.
             */
            errors?: {
                [key: string]: components["schemas"]["JsonValue"];
            }[] | null;
        };
        /**
         * Query
         * @description A query as everybody sees it: what was asked, where it stands, and its answer once it has one.
         */
        Query: {
            /** Id */
            id: number;
            /** Run */
            run: string;
            /**
             * State
             * @enum {string}
             */
            state: "open" | "leased" | "answered" | "cancelled";
            /** Priority */
            priority: number;
            /** Created At */
            created_at: number;
            /** Ask */
            ask: components["schemas"]["AskHierDemo"] | components["schemas"]["AskInspectFull"] | components["schemas"]["AskLabelHi"] | components["schemas"]["AskInspectLo"] | components["schemas"]["AskLabelLo"] | components["schemas"]["AskLabelFull"];
            /** Answer */
            answer: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /** Answer Id */
            answer_id: number | null;
            /**
             * Used
             * @description Whether the learner has used the answer; then it can be retracted no more.
             */
            used: boolean;
            /**
             * Annotator
             * @description Who answered, or who holds it now.
             */
            annotator: string | null;
            /**
             * Units
             * @description What the answer cost.
             */
            units: number | null;
            /**
             * Seconds
             * @description From lease to answer, by the server's clock.
             */
            seconds: number | null;
            /**
             * Active Seconds
             * @description The annotator's own time for it, without idle time.
             */
            active_seconds: number | null;
        };
        /**
         * QueryHistory
         * @description Everything that became of a query, oldest first, and its neighbors in its run.
         */
        QueryHistory: {
            /** Assignments */
            assignments: components["schemas"]["PastAssignment"][];
            /** Ledger */
            ledger: components["schemas"]["LedgerEntry"][];
            /**
             * Previous
             * @description The query asked before it in the run, by episode and ordinal.
             */
            previous: number | null;
            /** Next */
            next: number | null;
        };
        /**
         * QueryList
         * @description Queries of a run, newest first; `before` the last one's id goes on.
         */
        QueryList: {
            /** Queries */
            queries: components["schemas"]["Query"][];
        };
        /**
         * QueryPage
         * @description A page of a run's queries, newest first.
         */
        QueryPage: {
            /** Rows */
            rows: components["schemas"]["QueryRow"][];
            /**
             * Total
             * @description How many there are on all pages.
             */
            total: number;
            /**
             * Newest
             * @description The newest of them on any page.
             */
            newest: number | null;
            /**
             * Oldest
             * @description The oldest of them on any page.
             */
            oldest: number | null;
        };
        /**
         * QueryRow
         * @description A query in a table: what was asked and what came of it, without the trajectory.
         */
        QueryRow: {
            /** Id */
            id: number;
            /** Episode */
            episode: number;
            /** Ordinal */
            ordinal: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full";
            /**
             * State
             * @enum {string}
             */
            state: "open" | "leased" | "answered" | "cancelled";
            /** Priority */
            priority: number;
            /** Question */
            question: string;
            /** Created At */
            created_at: number;
            /** Answered At */
            answered_at: number | null;
            /** Answer */
            answer: (components["schemas"]["HierDemoAnswer"] | components["schemas"]["InspectAnswer"] | components["schemas"]["LabelHiAnswer"] | components["schemas"]["LabelLoAnswer"] | components["schemas"]["LabelFullAnswer"]) | null;
            /** Used */
            used: boolean;
            /**
             * Annotator
             * @description Who answered, or who holds it now.
             */
            annotator: string | null;
            /** Units */
            units: number | null;
            /** Seconds */
            seconds: number | null;
            /**
             * Skips
             * @description How often it was skipped.
             */
            skips: number;
            /**
             * Expiries
             * @description How many of its leases ran out.
             */
            expiries: number;
        };
        /**
         * Receipt
         * @description The answer is on disk and charged.
         */
        Receipt: {
            /** Query */
            query: number;
            /** Answer */
            answer: number;
            /** Units */
            units: number;
            /** Seconds */
            seconds: number;
            /** Active Seconds */
            active_seconds: number;
            next: components["schemas"]["Assignment"] | null;
        };
        /**
         * Release
         * @description Give a query back, unanswered.
         */
        Release: {
            /** Token */
            token: string;
            /**
             * Reason
             * @description Why; "" when only making room for others.
             * @default
             */
            reason: string;
            /**
             * Skip
             * @description True: do not offer it to this annotator again.
             * @default false
             */
            skip: boolean;
        };
        /**
         * Renew
         * @description A heartbeat.
         */
        Renew: {
            /** Token */
            token: string;
            /**
             * Active
             * @description The annotator did something since the last one: pressed, pointed, scrolled.
             * @default false
             */
            active: boolean;
        };
        /**
         * Renewal
         * @description The lease after a heartbeat.
         */
        Renewal: {
            /** Expires At */
            expires_at: number;
        };
        /**
         * Retract
         * @description Take an answer back.
         */
        Retract: {
            /** Token */
            token: string;
            /**
             * Tab
             * @description The page that will hold its query again.
             */
            tab?: string | null;
        };
        /**
         * Run
         * @description A run and where its money is: `spent + reserved <= budget`, always.
         */
        Run: {
            /** Id */
            id: string;
            /** Name */
            name: string;
            /** Algorithm */
            algorithm: string;
            /** Seed */
            seed: number;
            /**
             * State
             * @enum {string}
             */
            state: "running" | "paused" | "finished";
            vocabulary: components["schemas"]["Vocabulary"];
            /** Config */
            config: {
                [key: string]: components["schemas"]["JsonValue"];
            };
            prices: components["schemas"]["Prices"];
            /** Budget */
            budget: number | null;
            /**
             * Reserved
             * @description Units held for queries asked and not yet answered.
             */
            reserved: number;
            /** Spent */
            spent: number;
            /**
             * Priority
             * @description Queries of a run with a higher one are handed out first.
             */
            priority: number;
            /** Episodes */
            episodes: number | null;
            /** Episodes Done */
            episodes_done: number;
            /**
             * Success Rate
             * @description Over the trailing 100 test episodes; null before the first.
             */
            success_rate: number | null;
            /** Open Queries */
            open_queries: number;
            /** Gold Rate */
            gold_rate: number;
            /** Result */
            result: {
                [key: string]: components["schemas"]["JsonValue"];
            } | null;
            /** Created At */
            created_at: number;
            /** Finished At */
            finished_at: number | null;
        };
        /**
         * RunCreate
         * @description What a learner says of itself before it asks.
         */
        RunCreate: {
            /** Name */
            name: string;
            /** Algorithm */
            algorithm: string;
            /** Seed */
            seed: number;
            vocabulary: components["schemas"]["Vocabulary"];
            /**
             * Config
             * @description Every value that fixes the run.
             */
            config?: {
                [key: string]: components["schemas"]["JsonValue"];
            };
            prices?: components["schemas"]["PricesInput"];
            /**
             * Budget
             * @description Most units the run may ever cost; null for no limit.
             */
            budget?: number | null;
            /**
             * Episodes
             * @description How many episodes are planned.
             */
            episodes?: number | null;
        };
        /**
         * RunList
         * @description A page of runs.
         */
        RunList: {
            /** Runs */
            runs: components["schemas"]["Run"][];
            /**
             * Total
             * @description How many there are on all pages.
             */
            total: number;
        };
        /**
         * RunPatch
         * @description What may change in a run; absent fields stay as they are, and a null budget lifts it.
         */
        RunPatch: {
            /** Name */
            name?: string | null;
            /** State */
            state?: ("running" | "paused" | "finished") | null;
            /** Budget */
            budget?: number | null;
            /**
             * Priority
             * @description Queries of a run with a higher one are handed out first.
             */
            priority?: number | null;
            /**
             * Result
             * @description What the learner reports at its end.
             */
            result?: {
                [key: string]: components["schemas"]["JsonValue"];
            } | null;
            /** Gold Rate */
            gold_rate?: number | null;
        };
        /**
         * Segment
         * @description One (s_h, g_h, tau_h) of the learner's hierarchical trajectory.
         */
        SegmentInput: {
            /**
             * Subgoal
             * @description The subgoal the learner pursued; null for a flat policy.
             */
            subgoal: string | null;
            /**
             * States
             * @description s_1 .. s_{H+1}, in the domain's JSON view.
             */
            states: components["schemas"]["JsonValue"][];
            /**
             * Actions
             * @description a_1 .. a_H, one fewer than the states.
             */
            actions: string[];
            /**
             * Frames
             * @description A picture of each state, uploaded before; none where the page draws the states itself. Pictures are not part of what is asked: asking again with others changes nothing.
             */
            frames?: string[];
        };
        /**
         * Segment
         * @description One (s_h, g_h, tau_h) of the learner's hierarchical trajectory.
         */
        Segment: {
            /**
             * Subgoal
             * @description The subgoal the learner pursued; null for a flat policy.
             */
            subgoal: string | null;
            /**
             * States
             * @description s_1 .. s_{H+1}, in the domain's JSON view.
             */
            states: components["schemas"]["JsonValue"][];
            /**
             * Actions
             * @description a_1 .. a_H, one fewer than the states.
             */
            actions: string[];
            /**
             * Frames
             * @description A picture of each state, uploaded before; none where the page draws the states itself. Pictures are not part of what is asked: asking again with others changes nothing.
             */
            frames: string[];
        };
        /**
         * Session
         * @description A browser that is signed in.
         */
        Session: {
            /** Id */
            id: number;
            /** Created At */
            created_at: number;
            /** Last Used At */
            last_used_at: number | null;
            /** Expires At */
            expires_at: number;
            /**
             * Current
             * @description Whether this is the session that asks.
             */
            current: boolean;
        };
        /**
         * SessionList
         * @description The caller's sessions, oldest first.
         */
        SessionList: {
            /** Sessions */
            sessions: components["schemas"]["Session"][];
        };
        /**
         * Tally
         * @description What answers come to. Gold queries are among them: they are work too, though no run pays for them.
         */
        Tally: {
            /** Answers */
            answers: number;
            /** Units */
            units: number;
        };
        /**
         * Token
         * @description A token that is good, without its secret.
         */
        Token: {
            /** Id */
            id: number;
            /** Label */
            label: string;
            /** Created At */
            created_at: number;
            /**
             * Last Used At
             * @description To the minute; null if never.
             */
            last_used_at: number | null;
        };
        /**
         * TokenCreate
         * @description An API token for the caller, or, made by an administrator, for any user.
         */
        TokenCreate: {
            /**
             * User
             * @description Whose; null for the caller's own.
             */
            user?: number | null;
            /**
             * Label
             * @default
             */
            label: string;
        };
        /**
         * TokenList
         * @description A user's tokens that are good, oldest first.
         */
        TokenList: {
            /** Tokens */
            tokens: components["schemas"]["Token"][];
        };
        /**
         * User
         * @description A user, without secrets.
         */
        User: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /**
             * Role
             * @enum {string}
             */
            role: "admin" | "learner" | "annotator" | "viewer";
            /** Created At */
            created_at: number;
            /**
             * Deactivated At
             * @description Since when they may not call; null while they may.
             */
            deactivated_at: number | null;
            /**
             * Last Used At
             * @description When they last called, to the minute.
             */
            last_used_at: number | null;
        };
        /**
         * UserCreate
         * @description A person or a program that may call.
         */
        UserCreate: {
            /** Name */
            name: string;
            /**
             * Role
             * @enum {string}
             */
            role: "admin" | "learner" | "annotator" | "viewer";
        };
        /**
         * UserList
         * @description All users.
         */
        UserList: {
            /** Users */
            users: components["schemas"]["User"][];
        };
        /**
         * UserPatch
         * @description What may change in a user; absent fields stay as they are.
         */
        UserPatch: {
            /** Role */
            role?: ("admin" | "learner" | "annotator" | "viewer") | null;
            /**
             * Active
             * @description False ends their sessions, tokens, links and leases; their answers stay.
             */
            active?: boolean | null;
        };
        /**
         * Vocabulary
         * @description A domain's names, in the order of its own numbering, and how the page draws it.
         */
        Vocabulary: {
            /** Domain */
            domain: string;
            /**
             * Subgoals
             * @description Empty for a domain without subgoals.
             */
            subgoals: string[];
            /** Actions */
            actions: string[];
            /**
             * Renderer
             * @description Which of the page's renderers draws its instances and states.
             */
            renderer: string;
        };
        /**
         * PlayMoves
         * @description Annotator to learner: the whole demonstration as it stands, so that neither end must remember the other's past.
         *
         *     What changed since the last message, and in which direction, is for the learner to see.
         */
        PlayMoves: {
            /**
             * Type
             * @constant
             */
            type: "moves";
            /**
             * Number
             * @description Counts these messages; the reply repeats it.
             */
            number: number;
            /**
             * Segments
             * @description As in the answer; none before the first move.
             */
            segments: components["schemas"]["DemoSegment"][];
            /**
             * Known
             * @description States s_1 .. s_known need not be sent, the annotator has them.
             */
            known: number;
        };
        /**
         * PlayOffer
         * @description A learner's first message: it offers the query's environment.
         */
        PlayOffer: {
            /**
             * Type
             * @constant
             */
            type: "offer";
        };
        /**
         * PlayStage
         * @description Server to annotator: whether a learner offers the environment just now.
         */
        PlayStage: {
            /**
             * Type
             * @constant
             */
            type: "stage";
            /** Present */
            present: boolean;
        };
        /**
         * PlayStates
         * @description Learner to annotator: what the environment made of the moves.
         */
        PlayStates: {
            /**
             * Type
             * @constant
             */
            type: "states";
            /** Number */
            number: number;
            /**
             * Known
             * @description How many states come before these.
             */
            known: number;
            /**
             * States
             * @description The states after those, in the domain's JSON view, up to the episode's end.
             */
            states: components["schemas"]["JsonValue"][];
            /**
             * Frames
             * @description A picture of each of these, uploaded before; none where the page draws the states itself.
             */
            frames: string[];
            /**
             * Ended
             * @description Whether the episode ended in the last state; actions after it have no state.
             */
            ended: boolean;
            /**
             * Succeeded
             * @description Whether the whole task is accomplished in the last state.
             */
            succeeded: boolean;
        };
        /**
         * PlayTake
         * @description An annotator's first message: shows that it holds the query's live assignment.
         */
        PlayTake: {
            /**
             * Type
             * @constant
             */
            type: "take";
            /** Assignment */
            assignment: number;
            /** Token */
            token: string;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    listRuns: {
        parameters: {
            query?: {
                /** @description Words in the name, algorithm, domain or id. */
                text?: string;
                state?: ("running" | "paused" | "finished") | null;
                /** @description Only the runs with these ids. */
                run?: string[] | null;
                sort?: "newest" | "name" | "algorithm" | "episodes" | "success" | "cost";
                descending?: boolean;
                offset?: number;
                limit?: number;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["RunList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createRun: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RunCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    patchRun: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RunPatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run is finished; The budget is too low */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    reportEpisodes: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["EpisodeList"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Run"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Already there with other content; The run is finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getCurves: {
        parameters: {
            query?: {
                /** @description Only the episodes after this one. */
                after?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Curves"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getCosts: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Costs"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listQueries: {
        parameters: {
            query?: {
                state?: ("open" | "leased" | "answered" | "cancelled") | null;
                kind?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full") | null;
                episode?: number | null;
                before?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["QueryList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    ask: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AskList"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Asked"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run's budget is exhausted */
            402: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Already there with other content; The run is finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many open queries */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getQuery: {
        parameters: {
            query?: {
                /** @description Wait for a change at most so long, in seconds. */
                wait?: number;
            };
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Query"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listAnswers: {
        parameters: {
            query?: {
                after?: number;
                /** @description Wait for a change at most so long, in seconds. */
                wait?: number;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AnswerPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    useAnswer: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Query"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not answered */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    myAssignments: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AssignmentList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    lease: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Lease"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Assignment"];
                };
            };
            /** @description There was no query within `wait` seconds. */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    leave: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Leave"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    renew: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Renew"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Renewal"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The lease has expired; The assignment has ended */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    release: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Release"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The lease has expired; The assignment has ended */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    answer: {
        parameters: {
            query?: never;
            header?: {
                /** @description Names this attempt. Sending the same attempt again returns the same receipt. */
                "Idempotency-Key"?: string | null;
            };
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AnswerPost"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Receipt"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The lease has expired; The assignment has ended; The query was cancelled; The answer was taken back; Already there with other content; Idempotency-Key already used */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    retract: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                assignment: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Retract"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Assignment"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The run's budget is exhausted */
            402: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Another annotator's assignment; Not the token of this assignment */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The assignment has ended; The learner has used the answer; The answer was taken back; The run is finished */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listQueryRows: {
        parameters: {
            query?: {
                state?: ("open" | "leased" | "answered" | "cancelled") | null;
                kind?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full") | null;
                episode?: number | null;
                annotator?: string | null;
                /** @description Only rows older than this one. */
                before?: number | null;
                /** @description The rows just newer than this one. */
                after?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["QueryPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listLedger: {
        parameters: {
            query?: {
                kind?: ("hier_demo" | "inspect_full" | "label_hi" | "inspect_lo" | "label_lo" | "label_full") | null;
                entry?: ("charge" | "refund") | null;
                /** @description Only rows older than this one. */
                before?: number | null;
                /** @description The rows just newer than this one. */
                after?: number | null;
                limit?: number;
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LedgerPage"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getHistory: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["QueryHistory"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listAtWork: {
        parameters: {
            query?: {
                run?: string | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AtWorkList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    exportRun: {
        parameters: {
            query?: {
                table?: "curves" | "ledger" | "queries";
                format?: "csv" | "jsonl";
            };
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table, one row per line. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": unknown;
                    "application/jsonl": unknown;
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    streamEvents: {
        parameters: {
            query?: {
                /** @description Only events after this id; without it, only new events. */
                after?: number | null;
            };
            header?: {
                "last-event-id"?: string | null;
            };
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Server-sent events; each `data` is an Event. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": unknown;
                    "application/json": components["schemas"]["Event"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    streamChanges: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Server-sent events; each `data` is a Change. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/event-stream": unknown;
                    "application/json": components["schemas"]["Change"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    putFrames: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FrameUpload"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    missingFrames: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FrameHashes"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["FrameHashes"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getFrame: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description The SHA-256 of the PNG. */
                frame: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The picture. */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "image/png": unknown;
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listUsers: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["UserList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createUser: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["UserCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["User"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The name is taken */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getUser: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["User"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    patchUser: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["UserPatch"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["User"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The last administrator stays */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createLoginLink: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: {
            content: {
                "application/json": components["schemas"]["LoginLinkCreate"] | null;
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["LoginLink"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The user is deactivated */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listTokens: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TokenList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getNumbers: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                user: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Numbers"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listNumbers: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NumbersList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    createToken: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TokenCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["NewToken"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The user is deactivated */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    revokeToken: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                token: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    login: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Login"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Me"];
                };
            };
            /** @description Log in first; The login link was used before; The login link is too old; The account is deactivated */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many attempts */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    logout: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    me: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Me"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    myNumbers: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Numbers"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    myTokens: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TokenList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    mySessions: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SessionList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    logoutEverywhere: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    listGold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["GoldList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    addGold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["GoldPost"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["GoldList"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not answered */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    retireGold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                run: string;
                item: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    getPractice: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Practice"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    practice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                query: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PracticeAnswer"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not found */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Send application/json */
            415: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    healthz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    readyz: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Health"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    metrics: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/plain": string;
                };
            };
            /** @description Log in first */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Not allowed; Refused from another site */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The request is not valid */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The store failed */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
}
